#include "LightPlane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace gnomon::shadow_fit {
namespace {

using math::dmat3;
using math::dmat4;
using math::dvec2;
using math::dvec3;
using math::dvec4;

/// A cone of nearly half a sphere has no useful frustum: 85 degrees is as far as one map goes.
double usableHalfAngle(const LightShape& light) {
    return std::clamp(light.halfAngle, 0.01, 1.4835);
}

}  // namespace

std::pair<dvec3, dvec3> perpendicular(const dvec3& axis) noexcept {
    const double sign = std::copysign(1.0, axis.z);
    const double a = -1.0 / (sign + axis.z);  // sign + z is at least 1 in size
    const double b = axis.x * axis.y * a;
    return {dvec3{1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x},
            dvec3{b, sign + axis.y * axis.y * a, -axis.y}};
}

LightPlane::LightPlane(const LightShape& light)
    : toward_{-light.direction}, parallel_{light.kind == LightKind::directional} {
    const auto [u, v] = perpendicular(toward_);
    const dvec3 from = parallel_ ? dvec3{0.0} : light.position;
    x_ = dvec4{u, -glm::dot(u, from)};
    y_ = dvec4{v, -glm::dot(v, from)};
    w_ = parallel_ ? dvec4{0.0, 0.0, 0.0, 1.0} : dvec4{-toward_, glm::dot(toward_, from)};
}

dvec2 LightPlane::moved(const dvec3& point, const dvec3& by) const noexcept {
    const dvec3 h = at(point);
    const dvec4 d{by, 0.0};
    const dvec2 step{glm::dot(x_, d), glm::dot(y_, d)};
    if (parallel_) return step;
    if (!(h.z > 0.0)) return dvec2{0.0};
    return (step - dvec2{h} / h.z * glm::dot(w_, d)) / h.z;
}

LightPlane::Depth LightPlane::depthOf(std::span<const dvec3> receivers,
                                      const math::Box& casters) const {
    if (!parallel_) {
        double far = 0.0;
        for (const dvec3& p : receivers) far = std::max(far, at(p).z);
        far = std::max(far * 1.001, 1e-3);
        // Casters nearer than this are clamped and still cast. Closer, and the rasterizer's float
        // plane equations lose the offset: at 1e-4 of far llvmpipe speckles what the light stands
        // over.
        return {.nearest = std::max(far * 0.02, 1e-4), .farthest = far};
    }
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const dvec3& p : receivers) {
        low = std::min(low, glm::dot(p, toward_));
        high = std::max(high, glm::dot(p, toward_));
    }
    if (!casters.empty())
        for (int i = 0; i < 8; ++i) high = std::max(high, glm::dot(casters.corner(i), toward_));
    // Never nothing, not even of a point so far away that a micrometre is lost on it.
    const double slack =
        1e-3 * (high - low) + 1e-6 + 1e-12 * std::max(std::abs(low), std::abs(high));
    return {.nearest = -(high + slack), .farthest = -(low - slack)};
}

dmat4 LightPlane::clipFromWorld(const dmat3& m, const Depth& depth) const noexcept {
    const dvec4 rows[3] = {x_, y_, w_};
    const auto combined = [&](int row) {
        return rows[0] * m[0][row] + rows[1] * m[1][row] + rows[2] * m[2][row];
    };
    // Reversed depth. With a warp's w, which is constant along a ray, it stays monotone on every
    // ray and within [0, 1].
    const double range = depth.farthest - depth.nearest;
    const dvec4 one{0.0, 0.0, 0.0, 1.0};
    const dvec4 z = parallel_ ? (dvec4{toward_, 0.0} + one * depth.farthest) / range
                              : (one * depth.farthest - w_) * (depth.nearest / range);
    dmat4 transposed{combined(0), combined(1), z, combined(2)};
    return glm::transpose(transposed);
}

dmat4 coneCamera(const LightShape& light, double near, double far) {
    const auto [u, v] = perpendicular(-light.direction);
    (void)u;
    const dmat4 lightFromWorld = math::lookAt(light.position, light.position + light.direction, v);
    return math::perspective(2.0 * usableHalfAngle(light), 1.0, near, far) * lightFromWorld;
}

namespace {

/// Takes out most points that are inside: those well within the polygon of the furthest in some
/// directions.
/// Source: S. Akl, G. Toussaint. A Fast Convex Hull Algorithm. 1978.
template <std::size_t Count>
void dropInner(std::vector<dvec2>& points) {
    if (points.size() < 2 * Count) return;
    std::array<dvec2, Count> extreme;
    extreme.fill(points.front());
    for (std::size_t i = 0; i < Count; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / Count;
        const dvec2 direction{std::cos(angle), std::sin(angle)};
        double reach = -std::numeric_limits<double>::infinity();
        for (const dvec2& p : points) {
            const double here = glm::dot(p, direction);
            if (here <= reach) continue;
            reach = here;
            extreme[i] = p;
        }
    }
    const dvec2 size = extreme[0] - extreme[Count / 2];
    const dvec2 across = extreme[Count / 4] - extreme[3 * Count / 4];
    const double margin = 1e-12 * (glm::dot(size, size) + glm::dot(across, across));
    if (!(margin > 0.0)) return;
    std::erase_if(points, [&](const dvec2& p) {
        for (std::size_t i = 0; i < Count; ++i) {
            const dvec2 edge = extreme[(i + 1) % Count] - extreme[i];
            if (edge != dvec2{0.0} && !(cross(edge, p - extreme[i]) > margin)) return false;
        }
        return true;
    });
}

}  // namespace

std::vector<dvec2> convexHull(std::vector<dvec2> points) {
    dropInner<8>(points);
    dropInner<32>(points);
    std::sort(points.begin(), points.end(), [](const dvec2& a, const dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<dvec2> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t start = hull.size();
        for (const dvec2& p : points) {
            while (hull.size() >= start + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

std::vector<dvec2> dilated(std::vector<dvec2> hull, double by) {
    if (!(by > 0.0)) return hull;
    const double radius = by / std::cos(std::numbers::pi / 8.0);
    std::vector<dvec2> around;
    around.reserve(hull.size() * 8);
    for (const dvec2& p : hull)
        for (int i = 0; i < 8; ++i) {
            const double angle = (i + 0.5) * std::numbers::pi / 4.0;
            around.push_back(p + radius * dvec2{std::cos(angle), std::sin(angle)});
        }
    return convexHull(std::move(around));
}

Outline outlineOf(const LightPlane& plane, const LightShape& light,
                  std::span<const dvec3> receivers, double around) {
    Outline outline;
    std::vector<dvec2> flat;
    flat.reserve(receivers.size());
    double farthest = 0.0;
    if (!plane.parallel())
        for (const dvec3& p : receivers) farthest = std::max(farthest, plane.at(p).z);
    for (const dvec3& p : receivers) {
        const dvec3 h = plane.at(p);
        // As near to a spot as this, rounding decides where it is.
        if (!plane.parallel() && !(h.z > 1e-6 * farthest)) {
            outline.atLight = true;
            continue;
        }
        flat.push_back(dvec2{h} / h.z);
    }
    if (!plane.parallel()) {
        const double reach = std::tan(usableHalfAngle(light));
        if (outline.atLight) {
            flat = {{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}};
        } else {
            for (dvec2& p : flat) p = glm::clamp(p, dvec2{-reach}, dvec2{reach});
        }
    }
    outline.hull = dilated(convexHull(std::move(flat)), around);
    return outline;
}

}  // namespace gnomon::shadow_fit
