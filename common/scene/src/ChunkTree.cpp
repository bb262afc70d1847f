#include <gnomon/scene/ChunkTree.h>

namespace gnomon::scene {
namespace {

math::Box boundsOf(const Chunk& chunk, const math::dmat4& world) {
    const bool ordered =
        chunk.min.x <= chunk.max.x && chunk.min.y <= chunk.max.y && chunk.min.z <= chunk.max.z;
    if (!ordered || chunk.indexCount == 0) return {};
    return math::transformed({.min = math::dvec3{chunk.min}, .max = math::dvec3{chunk.max}}, world);
}

}  // namespace

void ChunkTree::update(const FlatScene& flat) {
    const auto instances = flat.instances();
    if (flat.rebuilt()) {
        uses_.clear();
        firstUse_.clear();
        std::vector<math::Box> boxes;
        for (std::uint32_t i = 0; i < instances.size(); ++i) {
            firstUse_.push_back(static_cast<std::uint32_t>(uses_.size()));
            const math::dmat4& world = flat.worldFromLocal(instances[i]);
            const auto& chunks = instances[i].geometry->chunks;
            for (std::uint32_t c = 0; c < chunks.size(); ++c) {
                uses_.push_back({.instance = i, .chunk = c});
                boxes.push_back(instances[i].bounds.empty() ? math::Box{}
                                                            : boundsOf(chunks[c], world));
            }
        }
        firstUse_.push_back(static_cast<std::uint32_t>(uses_.size()));
        tree_.build(std::move(boxes));
        return;
    }
    for (const std::uint32_t i : flat.moved()) {
        const auto& instance = instances[i];
        const math::dmat4& world = flat.worldFromLocal(instance);
        for (std::uint32_t u = firstUse_[i]; u < firstUse_[i + 1]; ++u)
            tree_.move(u, instance.bounds.empty()
                              ? math::Box{}
                              : boundsOf(instance.geometry->chunks[uses_[u].chunk], world));
    }
    tree_.refit();
}

}  // namespace gnomon::scene
