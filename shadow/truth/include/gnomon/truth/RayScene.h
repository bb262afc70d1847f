#pragma once

#include <gnomon/scene/FlatScene.h>

#include <memory>
#include <optional>

namespace gnomon::truth {

/// Rays that are traced together; those that are not set are not traced.
class RayPacket {
public:
    static constexpr std::size_t size = 8;

    /// @param from       relative to the scene's origin
    /// @param direction  unit
    void set(std::size_t i, const math::dvec3& from, const math::dvec3& direction, double reach) {
        for (int k = 0; k < 3; ++k) {
            from_[k][i] = static_cast<float>(from[k]);
            direction_[k][i] = static_cast<float>(direction[k]);
        }
        reach_[i] = static_cast<float>(reach);
        valid_[i] = -1;
    }

private:
    friend class RayScene;
    alignas(32) float from_[3][size] = {};
    alignas(32) float direction_[3][size] = {};
    alignas(32) float reach_[size] = {};
    alignas(32) int valid_[size] = {};
};

/// What rays are traced relative to, where floats are finest: the eye, or the place of the scene
/// nearest to an eye far away from it. Whole metres, world.
inline math::dvec3 originFor(const math::Box& scene, const math::dvec3& eye) noexcept {
    return glm::round(scene.empty() ? eye : glm::clamp(eye, scene.min, scene.max));
}

/// A flat scene for exact rays: a two-level tree, geometries below and their uses above. What moves
/// refits the upper level; only new geometry builds anything.
///
/// Positions are relative to an origin near what is looked at, so that floats suffice. Opaque and
/// masked triangles are seen; those that may cast block. From one thread, but rays from many.
class RayScene {
public:
    explicit RayScene(const field::Aspect& aspect);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Follows the flat scene. Costs nothing where nothing changed and the origin is the same.
    void update(const scene::FlatScene& flat, const math::dvec3& origin);
    const math::dvec3& origin() const noexcept;
    /// Positions are relative to another origin from now on.
    void moveTo(const math::dvec3& origin);

    struct Hit {
        math::dvec3 position{0.0};  ///< relative to the origin; in the triangle to double precision
        math::dvec3 normal{0.0};    ///< of the triangle, unit, on the side the ray came from
        double distance = 0.0;      ///< along the ray, in lengths of its direction
    };
    /// The first surface that is drawn: single-sided ones from their front alone.
    /// @param from  relative to the origin
    std::optional<Hit> firstHit(const math::dvec3& from, const math::dvec3& direction,
                                double reach) const;
    /// Whether a caster, from either side, lies on the way.
    /// @param direction  unit
    bool blocked(const math::dvec3& from, const math::dvec3& direction, double reach) const;
    /// A bit of each ray that is.
    unsigned blocked(const RayPacket& packet) const;
    /// As blocked(), from a surface point: starts far enough from it not to hit the surface itself.
    bool shadowed(const Hit& hit, const math::dvec3& direction, double reach) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace gnomon::truth
