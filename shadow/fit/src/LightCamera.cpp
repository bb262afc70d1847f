#include "LightCamera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::shadow_fit {
namespace {

using math::dmat4;
using math::dvec2;
using math::dvec3;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Andrew's monotone chain. Counter-clockwise, without the points on its edges.
std::vector<dvec2> convexHull(std::vector<dvec2> points) {
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

/// Direction (unit) of a side of the smallest rectangle around the hull.
dvec2 smallestRectangleSide(const std::vector<dvec2>& hull) {
    dvec2 best{1.0, 0.0};
    double bestArea = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double length = glm::length(edge);
        if (!(length > 0.0)) continue;
        const dvec2 u = edge / length;
        double minU = 0.0, maxU = 0.0, minV = 0.0, maxV = 0.0;
        for (const dvec2& p : hull) {
            const dvec2 d = p - hull[i];
            const double along = glm::dot(d, u);
            const double beside = cross(u, d);
            minU = std::min(minU, along);
            maxU = std::max(maxU, along);
            minV = std::min(minV, beside);
            maxV = std::max(maxV, beside);
        }
        // The map is square, so of two rectangles with one area the squarer has the smaller texels;
        // the perimeter breaks ties.
        const double area = (maxU - minU) * (maxV - minV) + 1e-9 * (maxU - minU + maxV - minV);
        if (area < bestArea) {
            bestArea = area;
            best = u;
        }
    }
    return best;
}

/// Crops a map's clip space to [low, high] in x and y.
dmat4 cropped(const dmat4& clipFromWorld, dvec2 low, dvec2 high) {
    for (int i = 0; i < 2; ++i) {
        // No narrower than a millionth of the whole: a receiver seen edge-on still gets a map.
        const double least = 1e-6;
        if (high[i] - low[i] < least) {
            const double middle = (low[i] + high[i]) * 0.5;
            low[i] = middle - least * 0.5;
            high[i] = middle + least * 0.5;
        }
    }
    return math::tileFromWhole({.left = (low.x + 1.0) * 0.5,
                                .bottom = (low.y + 1.0) * 0.5,
                                .width = (high.x - low.x) * 0.5,
                                .height = (high.y - low.y) * 0.5}) *
           clipFromWorld;
}

}  // namespace

std::pair<dvec3, dvec3> perpendicular(const dvec3& axis) noexcept {
    const double sign = std::copysign(1.0, axis.z);
    const double a = -1.0 / (sign + axis.z);  // sign + z is at least 1 in size
    const double b = axis.x * axis.y * a;
    return {dvec3{1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x},
            dvec3{b, sign + axis.y * axis.y * a, -axis.y}};
}

dmat4 parallelCamera(const FitInput& input, std::span<const dvec3> receivers) {
    const dvec3 toLight = -input.light.direction;
    const auto [u, v] = perpendicular(toLight);
    std::vector<dvec2> flat;
    flat.reserve(receivers.size());
    for (const dvec3& p : receivers) flat.emplace_back(glm::dot(p, u), glm::dot(p, v));
    const dvec2 side = smallestRectangleSide(convexHull(std::move(flat)));
    const dvec3 x = u * side.x + v * side.y;
    const dvec3 y = glm::cross(toLight, x);

    dmat4 lightFromWorld{1.0};
    for (int i = 0; i < 3; ++i) {
        lightFromWorld[i][0] = x[i];
        lightFromWorld[i][1] = y[i];
        lightFromWorld[i][2] = toLight[i];
    }
    dvec3 low{std::numeric_limits<double>::infinity()};
    dvec3 high = -low;
    for (const dvec3& p : receivers) {
        const dvec3 q{glm::dot(p, x), glm::dot(p, y), glm::dot(p, toLight)};
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    // Room for half a texel of filter and one of offset at the border, and toward the light for
    // every caster.
    const double border = 2.0 / std::max(input.mapSize, 8);
    const dvec2 extent =
        glm::max(dvec2{high} - dvec2{low}, dvec2{1e-6 * input.scene.radius() + 1e-9});
    low = dvec3{dvec2{low} - extent * border, low.z};
    high = dvec3{dvec2{high} + extent * border, high.z};
    for (int i = 0; i < 8; ++i) high.z = std::max(high.z, glm::dot(input.scene.corner(i), toLight));
    const double slack = 1e-3 * (high.z - low.z) + 1e-6;
    low.z -= slack;
    high.z += slack;
    return math::orthographic(low, high) * lightFromWorld;
}

dmat4 coneCamera(const LightShape& light, double near, double far) {
    const auto [u, v] = perpendicular(-light.direction);
    (void)u;
    const dmat4 lightFromWorld = math::lookAt(light.position, light.position + light.direction, v);
    // A cone of nearly half a sphere has no useful frustum: 85 degrees is as far as one map goes.
    const double half = std::clamp(light.halfAngle, 0.01, 1.4835);
    return math::perspective(2.0 * half, 1.0, near, far) * lightFromWorld;
}

dmat4 spotCamera(const FitInput& input, std::span<const dvec3> receivers) {
    double far = 0.0;
    for (const dvec3& p : receivers)
        far = std::max(far, glm::dot(p - input.light.position, input.light.direction));
    far = std::max(far * 1.001, 1e-3);
    // Casters nearer than this are clamped and still cast. Closer, and the rasterizer's float plane
    // equations lose the offset: at 1e-4 of far llvmpipe speckles what the light stands over.
    const double near = std::max(far * 0.02, 1e-4);
    const dmat4 whole = coneCamera(input.light, near, far);
    dvec2 low{1.0};
    dvec2 high{-1.0};
    for (const dvec3& p : receivers) {
        const math::dvec4 clip = whole * math::dvec4{p, 1.0};
        if (clip.w < near) {  // at or behind the light: it may be anywhere in the map
            low = dvec2{-1.0};
            high = dvec2{1.0};
            break;
        }
        const dvec2 q = dvec2{clip} / clip.w;
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    const double border = 2.0 / std::max(input.mapSize, 8);
    const dvec2 extent = high - low;
    return cropped(whole, glm::max(low - extent * border, dvec2{-1.0}),
                   glm::min(high + extent * border, dvec2{1.0}));
}

}  // namespace gnomon::shadow_fit
