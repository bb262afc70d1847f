#pragma once

#include <gnomon/math/View.h>
#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Light.h>
#include <gnomon/scene/Material.h>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace gnomon::scene {

/// What is below a root, as lists: every use of a geometry with its place in the world, and every
/// light. Kept up to date from what change lists did: a moved transform costs what is below it,
/// a change of structure builds the lists anew.
class FlatScene {
public:
    static constexpr std::size_t maxLights = 64;  ///< more are left out, see lightsLeftOut()

    /// One use of a geometry.
    struct Instance {
        const Node* node = nullptr;
        const Geometry* geometry = nullptr;
        const Material* material = nullptr;  ///< nullptr: the default
        std::uint32_t place = 0;
        std::uint64_t lights = 0;  ///< bit i: lit by lights()[i]
        bool castsShadow = true;
        bool mirrored = false;  ///< negative determinant: front faces are clockwise
        math::Box bounds = {};  ///< world
    };
    struct LightUse {
        const Node* node = nullptr;
        const Light* light = nullptr;
        math::dmat4 worldFromBeacon{1.0};
    };

    explicit FlatScene(const field::Aspect& aspect) : aspect_{aspect} {}

    /// @param root      what to flatten; another one than before builds the lists anew
    /// @param excluded  subtrees that cast no shadow
    void update(Ref<Node> root, std::span<const Ref<Node>> excluded, const field::Applied& applied);

    std::span<const Instance> instances() const noexcept { return instances_; }
    std::span<const LightUse> lights() const noexcept { return lights_; }
    std::size_t lightsLeftOut() const noexcept { return lightsLeftOut_; }
    const math::dmat4& worldFromLocal(const Instance& i) const noexcept {
        return places_[i.place].world;
    }
    /// Bounds of everything that is drawn; empty where nothing is.
    math::Box bounds() const noexcept { return bounds_; }

    // What the last update() did:
    bool rebuilt() const noexcept { return rebuilt_; }
    bool lightsChanged() const noexcept { return lightsChanged_; }
    /// Instances that moved, by index.
    std::span<const std::uint32_t> moved() const noexcept { return moved_; }
    /// Where they were and are, one box each.
    std::span<const math::Box> movedBounds() const noexcept { return movedBounds_; }

private:
    struct Place {
        std::uint32_t parent = 0;
        const Transform* transform = nullptr;
        math::dmat4 world{1.0};
        std::uint32_t firstInstance = 0, lastInstance = 0;
        bool dirty = false;
    };

    void rebuild(Ref<Node> root, std::span<const Ref<Node>> excluded);
    void refreshPlaces();
    void refreshLights();
    static math::Box localBounds(const Geometry& geometry);

    const field::Aspect& aspect_;
    Ref<Node> root_ = {};
    std::vector<Ref<Node>> excluded_;
    std::vector<Place> places_;
    std::vector<std::uint32_t> instanceOrder_;
    std::vector<Instance> instances_;
    std::vector<LightUse> lights_;
    std::unordered_multimap<field::Id, std::uint32_t> placesOf_;  // by transform core
    std::unordered_set<field::Id> parts_;  // everything the lists were built from
    math::Box bounds_;
    std::vector<std::uint32_t> moved_;
    std::vector<math::Box> movedBounds_;
    std::size_t lightsLeftOut_ = 0;
    bool built_ = false;
    bool rebuilt_ = false;
    bool lightsChanged_ = false;
};

}  // namespace gnomon::scene
