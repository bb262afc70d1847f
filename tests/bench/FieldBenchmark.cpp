// What change lists cost: many small changes, bulk data, and a joiner's snapshot. Real time of one
// thread; the rates are the claims (transforms a second, bytes a second).
#include <benchmark/benchmark.h>
#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Types.h>

#include <cstdint>
#include <random>
#include <vector>

namespace gnomon {
namespace {

constexpr int transformCount = 10'000;

field::TypeRegistry sceneTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    return types;
}

/// A flat scene of transforms, and a second aspect that follows it.
struct Scene {
    Scene() {
        const scene::Node& root = source.create<scene::Node>();
        for (int i = 0; i < transformCount; ++i) {
            const auto made = scene::makeNode<scene::Transform>(source, "node");
            edit(root)->addChild(made.node);
            transforms.push_back(&made.core);
        }
        orThrow(replica.apply(source.commit()));
    }
    void moveAll() {
        ++step;
        for (const scene::Transform* transform : transforms)
            edit(*transform)->matrix = math::Affine{.translation = math::dvec3{step, 0.0, 0.0}};
    }

    field::TypeRegistry types = sceneTypes();
    field::Aspect source{types, 1};
    field::Aspect replica{types, 0};
    std::vector<const scene::Transform*> transforms = {};
    double step = 0.0;
};

void editAndCommit(benchmark::State& state) {
    Scene scene;
    std::size_t bytes = 0;
    for (auto _ : state) {
        scene.moveAll();
        const auto list = scene.source.commit();
        bytes = list.bytes.size();
        benchmark::DoNotOptimize(list.bytes.data());
    }
    state.SetItemsProcessed(state.iterations() * transformCount);
    state.counters["bytesPerChange"] = static_cast<double>(bytes) / transformCount;
}
BENCHMARK(editAndCommit)->Unit(benchmark::kMicrosecond);

void applyTransforms(benchmark::State& state) {
    Scene scene;
    std::vector<field::ChangeList> lists;
    for (int i = 0; i < 4; ++i) {
        scene.moveAll();
        lists.push_back(scene.source.commit());
    }
    std::size_t at = 0;
    field::Applied applied;
    for (auto _ : state) {
        applied.clear();
        orThrow(scene.replica.apply(lists[at++ % lists.size()], &applied));
    }
    state.SetItemsProcessed(state.iterations() * transformCount);
}
BENCHMARK(applyTransforms)->Unit(benchmark::kMicrosecond);

void digestOfChanges(benchmark::State& state) {
    Scene scene;
    for (auto _ : state) {
        state.PauseTiming();
        scene.moveAll();
        state.ResumeTiming();
        benchmark::DoNotOptimize(scene.source.digest());
    }
    state.SetItemsProcessed(state.iterations() * transformCount);
}
BENCHMARK(digestOfChanges)->Unit(benchmark::kMicrosecond);

std::vector<std::byte> randomBytes(std::size_t size) {
    std::mt19937_64 random{7};
    std::vector<std::byte> bytes(size);
    for (auto& b : bytes) b = static_cast<std::byte>(random());
    return bytes;
}

/// New bulk data a frame: address it by its content, commit, apply to a second aspect.
void bulkPayload(benchmark::State& state) {
    const auto size = static_cast<std::size_t>(state.range(0));
    const auto types = sceneTypes();
    field::Aspect source{types, 1};
    field::Aspect replica{types, 0};
    const auto& geometry = source.create<scene::Geometry>();
    orThrow(replica.apply(source.commit()));
    auto bytes = randomBytes(size);
    for (auto _ : state) {
        state.PauseTiming();
        bytes[0] = static_cast<std::byte>(static_cast<unsigned>(bytes[0]) + 1U);
        auto copy = bytes;
        state.ResumeTiming();
        edit(geometry)->positions = field::Payload{std::move(copy)};
        orThrow(replica.apply(source.commit()));
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}
BENCHMARK(bulkPayload)->Arg(1 << 20)->Arg(64 << 20)->Unit(benchmark::kMicrosecond);

/// A large multi field travels by value.
void bulkMultiField(benchmark::State& state) {
    const auto types = sceneTypes();
    field::Aspect source{types, 1};
    field::Aspect replica{types, 0};
    const auto& geometry = source.create<scene::Geometry>();
    orThrow(replica.apply(source.commit()));
    std::vector<scene::Chunk> chunks(100'000);
    std::uint32_t step = 0;
    for (auto _ : state) {
        chunks[0].firstIndex = ++step;
        edit(geometry)->chunks.assign(chunks);
        orThrow(replica.apply(source.commit()));
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(chunks.size()) * 33);
}
BENCHMARK(bulkMultiField)->Unit(benchmark::kMicrosecond);

void snapshotOfNodes(benchmark::State& state) {
    Scene scene;
    std::size_t bytes = 0;
    for (auto _ : state) {
        const auto list = scene.source.snapshot();
        bytes = list.bytes.size();
        benchmark::DoNotOptimize(list.bytes.data());
    }
    state.SetItemsProcessed(state.iterations() * transformCount);
    state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(snapshotOfNodes)->Unit(benchmark::kMicrosecond);

void joinFromSnapshot(benchmark::State& state) {
    Scene scene;
    const auto list = scene.source.snapshot();
    for (auto _ : state) {
        field::Aspect joiner{scene.types, 0};
        orThrow(joiner.apply(list));
        benchmark::DoNotOptimize(joiner.digest());
    }
    state.SetItemsProcessed(state.iterations() * transformCount);
}
BENCHMARK(joinFromSnapshot)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gnomon
