#pragma once

#include <gnomon/math/BoxTree.h>
#include <gnomon/scene/FlatScene.h>

namespace gnomon::scene {

/// Every use of every chunk of a flat scene, in a tree by where it is in the world: what culling
/// looks through. Follows the flat scene's changes.
class ChunkTree {
public:
    struct Use {
        std::uint32_t instance = 0;  ///< in FlatScene::instances()
        std::uint32_t chunk = 0;     ///< of its geometry
    };

    /// After the flat scene's own update().
    void update(const FlatScene& flat);

    std::span<const Use> uses() const noexcept { return uses_; }
    /// World bounds of a use; empty where nothing can be seen of it.
    const math::Box& bounds(std::uint32_t use) const noexcept { return tree_.boxes()[use]; }
    const math::BoxTree& tree() const noexcept { return tree_; }

private:
    std::vector<Use> uses_;
    std::vector<std::uint32_t> firstUse_;  // per instance, and one past the last
    math::BoxTree tree_;
};

}  // namespace gnomon::scene
