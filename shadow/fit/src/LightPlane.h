#pragma once

#include <gnomon/shadow_fit/Fit.h>
#include <gnomon/shadow_fit/Outline.h>

#include <optional>
#include <span>
#include <vector>

namespace gnomon::shadow_fit {

inline double cross(const math::dvec2& a, const math::dvec2& b) noexcept {
    return a.x * b.y - a.y * b.x;
}

/// A light's rays, each a point of a plane: what every shadow map of that light has in common. A
/// map is this plane seen through a projective map of the plane, and a depth.
///
/// Of parallel light: the plane across the rays, in metres. Of a spot: the plane one metre in front
/// of it.
class LightPlane {
public:
    explicit LightPlane(const LightShape& light);

    /// Homogeneous place on the plane: x, y and w. w > 0 in front of the light; 1 for parallel
    /// light.
    math::dvec3 at(const math::dvec3& world) const noexcept {
        const math::dvec4 p{world, 1.0};
        return {glm::dot(x_, p), glm::dot(y_, p), glm::dot(w_, p)};
    }
    bool parallel() const noexcept { return parallel_; }
    /// Toward the light where it is parallel, against its axis otherwise: unit, world.
    const math::dvec3& toward() const noexcept { return toward_; }
    /// How places move with a world vector, at a world point.
    math::dvec2 moved(const math::dvec3& at, const math::dvec3& by) const noexcept;

    /// The world plane of a line a x + b y + c w = 0, inside where that is positive.
    math::Plane through(const math::dvec3& line) const noexcept {
        const math::dvec4 p = x_ * line.x + y_ * line.y + w_ * line.z;
        const double length = glm::length(math::dvec3{p});
        return length > 0.0 ? math::Plane{math::dvec3{p} / length, p.w / length}
                            : math::Plane{math::dvec3{0.0}, 0.0};
    }

    /// Distances along the axis that a map has to tell apart: from the farthest receiver to the
    /// nearest caster.
    struct Depth {
        double nearest = 0.0, farthest = 0.0;
    };
    Depth depthOf(std::span<const math::dvec3> receivers, const math::Box& casters) const;

    /// clipFromWorld of the map that shows the plane through @p mapFromPlane, which maps what is
    /// shown to [-1, 1]^2 with its third row > 0 there, >= 1 at the least.
    math::dmat4 clipFromWorld(const math::dmat3& mapFromPlane, const Depth& depth) const noexcept;

private:
    math::dvec4 x_{0.0}, y_{0.0}, w_{0.0};  // rows
    math::dvec3 toward_{0.0, 1.0, 0.0};
    bool parallel_ = true;
};

/// The frustum of a spot's whole cone, without regard to receivers.
math::dmat4 coneCamera(const LightShape& light, double near, double far);

/// What of a light's plane a map must show: the convex outline of receivers.
struct Outline {
    std::vector<math::dvec2> hull = {};  ///< counter-clockwise; fewer than 3 points: flat
    /// Some receivers are at the light itself, where they may be anywhere: the hull is the cone's.
    bool atLight = false;
};
/// @param around  how much more than the receivers it holds, in units of the plane
Outline outlineOf(const LightPlane& plane, const LightShape& light,
                  std::span<const math::dvec3> receivers, double around);

}  // namespace gnomon::shadow_fit
