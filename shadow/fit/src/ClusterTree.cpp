#include <gnomon/shadow_fit/ClusterTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::shadow_fit {

const std::vector<ClusterTree::LocalBox>& ClusterTree::clustersOf(const scene::Geometry& geometry) {
    const auto [found, isNew] = clusters_.try_emplace(geometry.id());
    std::vector<LocalBox>& boxes = found->second;
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
            const auto at = [&](std::size_t i) {
                const Vertex& v = positions[indices[i]];
                return math::vec3{v[0], v[1], v[2]};
            };
            for (std::size_t i = first; i < last; ++i) {
                if (indices[i] >= positions.size()) continue;
                box.min = glm::min(box.min, at(i));
                box.max = glm::max(box.max, at(i));
            }
            for (std::size_t i = first; corners == 3 && i + 2 < last; i += 3) {
                if (std::max({indices[i], indices[i + 1], indices[i + 2]}) >= positions.size())
                    continue;
                box.area += glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i))) * 0.5F;
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
    const auto density = [&](const scene::FlatScene::Instance& instance, const LocalBox& local,
                             const math::Box& box) {
        const double scale =
            std::cbrt(std::abs(glm::determinant(math::dmat3{flat.worldFromLocal(instance)})));
        const math::dvec3 size = box.size();
        const double volume = size.x * size.y * size.z;
        // What is flat stops everything, and so does what nothing is known of.
        return box.empty() || !(local.area > 0.0F) || !(volume > 0.0)
                   ? std::numeric_limits<double>::infinity()
                   : 0.25 * static_cast<double>(local.area) * scale * scale / volume;
    };
    if (flat.rebuilt()) {
        firstBox_.clear();
        densities_.clear();
        std::vector<math::Box> boxes;
        for (const auto& instance : instances) {
            firstBox_.push_back(static_cast<std::uint32_t>(boxes.size()));
            for (const LocalBox& local : clustersOf(*instance.geometry)) {
                boxes.push_back(worldBox(instance, local));
                densities_.push_back(density(instance, local, boxes.back()));
            }
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
