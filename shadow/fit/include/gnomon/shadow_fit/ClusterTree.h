#pragma once

#include <gnomon/math/BoxTree.h>
#include <gnomon/scene/FlatScene.h>

#include <unordered_map>

namespace gnomon::shadow_fit {

/// What is where in a scene, finer than its chunks: boxes around some dozens of triangles that
/// follow each other in their mesh. What the fits take for the scene.
class ClusterTree {
public:
    static constexpr std::size_t triangles = 48;  ///< of a cluster, at most

    /// After the flat scene's own update(). Looks through the vertices of geometries that are new.
    void update(const scene::FlatScene& flat, const field::Applied& applied);
    const math::BoxTree& boxes() const noexcept { return tree_; }

private:
    struct LocalBox {
        math::vec3 min{0.0F}, max{0.0F};
    };
    const std::vector<LocalBox>& clustersOf(const scene::Geometry& geometry);

    std::unordered_map<field::Id, std::vector<LocalBox>> clusters_;  // by geometry
    std::vector<std::uint32_t> firstBox_;  // per instance, and one past the last
    math::BoxTree tree_;
};

}  // namespace gnomon::shadow_fit
