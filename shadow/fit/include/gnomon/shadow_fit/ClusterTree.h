#pragma once

#include <gnomon/scene/FlatScene.h>
#include <gnomon/shadow_fit/Receivers.h>

#include <span>
#include <unordered_map>
#include <vector>

namespace gnomon::shadow_fit {

/// What is where in a scene, finer than its chunks: boxes around some dozens of triangles that
/// follow each other in their mesh. What the fits take for the scene.
class ClusterTree {
public:
    static constexpr std::size_t triangles = 16;  ///< of a cluster, at most

    /// After the flat scene's own update(). Looks through the vertices of geometries that are new.
    void update(const scene::FlatScene& flat, const field::Applied& applied);
    Boxes boxes() const noexcept { return {.tree = tree_, .density = densities_}; }

private:
    struct LocalBox {
        math::vec3 min{0.0F}, max{0.0F};
        float area = 0.0F;  ///< of its triangles; none known: solid
    };

    const std::vector<LocalBox>& clustersOf(const scene::Geometry& geometry);

    std::unordered_map<field::Id, std::vector<LocalBox>> clusters_;  // by geometry
    std::vector<std::uint32_t> firstBox_;  // per instance, and one past the last
    std::vector<double> densities_;
    math::BoxTree tree_;
};

}  // namespace gnomon::shadow_fit
