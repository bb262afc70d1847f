#include <gnomon/shadow_fit/ClusterTree.h>

#include <array>

namespace gnomon::shadow_fit {

const std::vector<ClusterTree::LocalBox>& ClusterTree::clustersOf(const scene::Geometry& geometry) {
    const auto [at, isNew] = clusters_.try_emplace(geometry.id());
    std::vector<LocalBox>& boxes = at->second;
    if (!isNew) return boxes;
    using Vertex = std::array<float, 3>;
    const auto positions = geometry.positions->as<Vertex>();
    const auto indices = geometry.indices->as<std::uint32_t>();
    const std::size_t corners = geometry.primitive == scene::Primitive::triangles ? 3
                                : geometry.primitive == scene::Primitive::lines   ? 2
                                                                                  : 1;
    for (const scene::Chunk& chunk : geometry.chunks) {
        const std::size_t end = std::size_t{chunk.firstIndex} + chunk.indexCount;
        if (end > indices.size()) {
            // Without its vertices (a test, another process' scene) the chunk's own box.
            boxes.push_back({.min = chunk.min, .max = chunk.max});
            continue;
        }
        for (std::size_t first = chunk.firstIndex; first < end; first += triangles * corners) {
            LocalBox box{.min = math::vec3{std::numeric_limits<float>::max()},
                         .max = math::vec3{std::numeric_limits<float>::lowest()}};
            const std::size_t last = std::min(end, first + triangles * corners);
            for (std::size_t i = first; i < last; ++i) {
                if (indices[i] >= positions.size()) continue;
                const Vertex& v = positions[indices[i]];
                box.min = glm::min(box.min, math::vec3{v[0], v[1], v[2]});
                box.max = glm::max(box.max, math::vec3{v[0], v[1], v[2]});
            }
            boxes.push_back(box);
        }
    }
    return boxes;
}

void ClusterTree::update(const scene::FlatScene& flat, const field::Applied& applied) {
    for (const field::Id id : applied.destroyed) clusters_.erase(id);
    for (const auto& change : applied.changed) clusters_.erase(change.id);
    const auto instances = flat.instances();
    const auto worldBox = [&](const scene::FlatScene::Instance& instance, const LocalBox& box) {
        if (instance.bounds.empty() || !(box.min.x <= box.max.x)) return math::Box{};
        return math::transformed({.min = math::dvec3{box.min}, .max = math::dvec3{box.max}},
                                 flat.worldFromLocal(instance));
    };
    if (flat.rebuilt()) {
        firstBox_.clear();
        std::vector<math::Box> boxes;
        for (const auto& instance : instances) {
            firstBox_.push_back(static_cast<std::uint32_t>(boxes.size()));
            for (const LocalBox& box : clustersOf(*instance.geometry))
                boxes.push_back(worldBox(instance, box));
        }
        firstBox_.push_back(static_cast<std::uint32_t>(boxes.size()));
        tree_.build(std::move(boxes));
        return;
    }
    for (const std::uint32_t i : flat.moved()) {
        const auto& local = clustersOf(*instances[i].geometry);
        for (std::uint32_t b = firstBox_[i]; b < firstBox_[i + 1]; ++b)
            tree_.move(b, worldBox(instances[i], local[b - firstBox_[i]]));
    }
    tree_.refit();
}

}  // namespace gnomon::shadow_fit
