#include "Cases.h"

#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Node.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <random>

#include "Floor.h"

namespace gnomon::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t bulkBytes = std::size_t{100} << 20U;
constexpr int syncNodes = 10'000;
constexpr std::size_t mostSamples = 5'000;

double microseconds(Clock::duration span) {
    return std::chrono::duration<double, std::micro>(span).count();
}

/// Nearest rank.
double quantile(std::vector<double>& values, double share) {
    const auto rank =
        static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

field::Payload noise(unsigned seed) {
    std::mt19937_64 random{seed};
    std::vector<std::byte> bytes(bulkBytes);
    for (auto& b : bytes) b = static_cast<std::byte>(random() >> 56U);
    return field::Payload{std::move(bytes)};
}

/// Calls @p once until the time is over, at least five times, and keeps what each took.
template <class Once>
std::vector<double> repeat(double seconds, Once once) {
    std::vector<double> taken;
    const auto end = Clock::now() + std::chrono::duration<double>{seconds};
    auto since = Clock::now();
    while (taken.size() < 5 || (since < end && taken.size() < mostSamples)) {
        once();
        const auto now = Clock::now();
        taken.push_back(microseconds(now - since));
        since = now;
    }
    return taken;
}

std::vector<double> frames(const ClusterOptions& options, int transforms, double seconds) {
    Cluster cluster{options};
    field::Aspect aspect{cluster.types(), 2};
    std::vector<const scene::Transform*> moved;
    for (int i = 0; i < transforms; ++i) moved.push_back(&aspect.create<scene::Transform>());
    cluster.hub().frame(aspect.commit(), 0);
    cluster.join();
    double step = 0;
    const auto once = [&] {
        ++step;
        for (const scene::Transform* one : moved)
            field::edit(*one)->matrix = math::Affine{.translation = {step, 0, 0}};
        cluster.hub().frame(aspect.commit(), step);
    };
    for (int i = 0; i < 20; ++i) once();
    return repeat(seconds, once);
}

std::vector<double> bulk(const ClusterOptions& options, double seconds) {
    Cluster cluster{options};
    field::Aspect aspect{cluster.types(), 2};
    const scene::Geometry& mesh = aspect.create<scene::Geometry>();
    cluster.hub().frame(aspect.commit(), 0);
    cluster.join();
    const std::array payloads{noise(1), noise(2)};
    std::size_t next = 0;
    return repeat(seconds, [&] {
        field::edit(mesh)->positions = payloads[next];
        next = 1 - next;
        cluster.hub().frame(aspect.commit(), 0);
    });
}

std::vector<double> sync(const ClusterOptions& options) {
    std::vector<double> taken;
    for (int i = 0; i < 9; ++i) {
        Cluster cluster{options};
        field::Aspect aspect{cluster.types(), 2};
        const auto& root = scene::makeNode<scene::Group>(aspect, "root").node;
        {
            auto edit = field::edit(root);
            for (int n = 1; n < syncNodes; ++n)
                edit->addChild(scene::makeNode<scene::Transform>(aspect, "node").node);
        }
        cluster.hub().frame(aspect.commit(), 0);
        const auto since = Clock::now();
        cluster.join();
        taken.push_back(microseconds(Clock::now() - since));
    }
    return taken;
}

}  // namespace

Row measure(const std::string& name, const ClusterOptions& options, double seconds) {
    Row row{.name = name,
            .servers = options.servers,
            .pipeline = options.pipeline,
            .relay = options.relay,
            .tls = !options.key.empty()};
    std::vector<double> taken;
    int transforms = 0;
    const auto* const end = name.data() + name.size();
    if (name == "bulk") {
        taken = bulk(options, seconds);
        row.bytes = static_cast<double>(bulkBytes) * options.servers;
    } else if (name == "sync") {
        taken = sync(options);
    } else if (name == "floor") {
        taken = floorOf(options.servers, seconds);
        row.pipeline = 1;
        row.relay = 0;
        row.tls = false;
    } else if (name == "idle" || std::from_chars(name.data(), end, transforms).ptr == end) {
        taken = frames(options, transforms, seconds);
    } else {
        throw Failure{Errc::config,
                      "case \"" + name + "\", expected floor, idle, bulk, sync or a number"};
    }
    row.samples = taken.size();
    row.median = quantile(taken, 0.5);
    row.p99 = quantile(taken, 0.99);
    return row;
}

}  // namespace gnomon::bench
