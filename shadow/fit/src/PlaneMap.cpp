#include "PlaneMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow_fit {
namespace {

using math::dmat3;
using math::dvec2;
using math::dvec3;

/// Direction (unit) of a side of the smallest rectangle around the hull.
dvec2 smallestRectangleSide(std::span<const dvec2> hull) {
    dvec2 best{1.0, 0.0};
    double bestArea = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double length = glm::length(edge);
        if (!(length > 0.0)) continue;
        const dvec2 u = edge / length;
        const Extent along = extentAlong(hull, u);
        const Extent beside = extentAlong(hull, {-u.y, u.x});
        // The map is square, so of two rectangles with one area the squarer has the smaller texels;
        // the perimeter breaks ties.
        const double area =
            along.length() * beside.length() + 1e-9 * (along.length() + beside.length());
        if (area < bestArea) {
            bestArea = area;
            best = u;
        }
    }
    return best;
}

double largestSize(std::span<const dvec2> hull) {
    double size = 0.0;
    for (const dvec2& p : hull) size = std::max({size, std::abs(p.x), std::abs(p.y)});
    return size;
}

/// [low, high] to [-1, 1], with room at the border for what a lookup reaches beyond the outline.
/// @param least  no narrower than this: a receiver seen edge-on still gets a map
struct Crop {
    double scale = 1.0, offset = 0.0;
};
Crop cropOf(double low, double high, double least, int mapSize) {
    if (!(high - low >= least)) {
        const double middle = (low + high) * 0.5;
        low = middle - least * 0.5;
        high = middle + least * 0.5;
    }
    const double border = (high - low) * 2.0 / std::max(mapSize, 8);
    const double scale = 2.0 / (high - low + 2.0 * border);
    return {.scale = scale, .offset = -(low + high) * 0.5 * scale};
}

dvec3 row(const dmat3& m, int i) { return {m[0][i], m[1][i], m[2][i]}; }

}  // namespace

Extent extentAlong(std::span<const dvec2> hull, const dvec2& along) noexcept {
    Extent extent{.low = std::numeric_limits<double>::infinity(),
                  .high = -std::numeric_limits<double>::infinity()};
    for (const dvec2& p : hull) {
        const double at = glm::dot(p, along);
        extent.low = std::min(extent.low, at);
        extent.high = std::max(extent.high, at);
    }
    return extent;
}

std::optional<dmat3> croppedMap(std::span<const dvec2> hull, const dmat3& mapFromPlane,
                                int mapSize) {
    double leastW = std::numeric_limits<double>::infinity();
    for (const dvec2& p : hull) leastW = std::min(leastW, (mapFromPlane * dvec3{p, 1.0}).z);
    if (!(leastW > 0.0) || !std::isfinite(leastW)) return {};
    const dmat3 scaled = mapFromPlane * (1.0 / leastW);
    dvec2 low{std::numeric_limits<double>::infinity()};
    dvec2 high = -low;
    for (const dvec2& p : hull) {
        const dvec3 h = scaled * dvec3{p, 1.0};  // h.z >= 1
        low = glm::min(low, dvec2{h} / h.z);
        high = glm::max(high, dvec2{h} / h.z);
    }
    // A millionth of what the numbers are like: narrower, and rounding fills the map.
    const double size =
        std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y),
                  high.x - low.x, high.y - low.y, 1e6 * narrowestMap});
    const Crop x = cropOf(low.x, high.x, 1e-6 * size, mapSize);
    const Crop y = cropOf(low.y, high.y, 1e-6 * size, mapSize);
    const dvec3 w = row(scaled, 2);
    const dvec3 rows[3] = {row(scaled, 0) * x.scale + w * x.offset,
                           row(scaled, 1) * y.scale + w * y.offset, w};
    dmat3 done{1.0};
    for (int i = 0; i < 3; ++i)
        for (int column = 0; column < 3; ++column) done[column][i] = rows[i][column];
    for (int column = 0; column < 3; ++column)
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(done[column][i])) return {};
    return done;
}

dmat3 uniformMap(std::span<const dvec2> hull, int mapSize) {
    if (const auto map = warpedMap(hull, {.along = smallestRectangleSide(hull)}, mapSize))
        return *map;
    return dmat3{1.0};  // of no point at all
}

std::optional<dmat3> warpedMap(std::span<const dvec2> hull, const Warp& warp, int mapSize) {
    const dvec2& a = warp.along;
    const dvec2 b{a.y, -a.x};
    const Extent extent = extentAlong(hull, a);
    const double length = std::max(extent.length(), 1e-9 * largestSize(hull) + narrowestMap);
    const double k = warp.strength / length;  // w = 1 + k (along - low)
    dmat3 m{1.0};
    m[0] = {b.x, a.x, k * a.x};
    m[1] = {b.y, a.y, k * a.y};
    m[2] = {-warp.beside, -extent.low, 1.0 - k * extent.low};
    return croppedMap(hull, m, mapSize);
}

double expectedError(const LightPlane& plane, const dmat3& m, int mapSize,
                     std::span<const Sample> samples) {
    double sum = 0.0;
    double weights = 0.0;
    const double texel = 2.0 / mapSize;  // in map units
    for (const Sample& sample : samples) {
        const dvec3 h = plane.at(sample.world);
        if (!(h.z > 0.0)) continue;
        const dvec2 p = dvec2{h} / h.z;
        const dvec3 q = m * dvec3{p, 1.0};
        if (!(q.z > 0.0)) continue;
        const dvec2 at = dvec2{q} / q.z;
        if (std::abs(at.x) > 1.0 || std::abs(at.y) > 1.0) continue;
        // Derivatives of the place in the map by the place on the plane.
        const dvec2 dx = (dvec2{m[0]} - at * m[0].z) / q.z;
        const dvec2 dy = (dvec2{m[1]} - at * m[1].z) / q.z;
        const double area = std::abs(cross(dx, dy));
        if (!(area > 0.0)) continue;
        // Sides of a texel on the plane: columns of the inverse.
        const double side =
            texel * 0.5 * (glm::length(dvec2{dy.y, dx.y}) + glm::length(dvec2{dy.x, dx.x})) / area;
        sum += side * h.z * sample.weight;
        weights += sample.weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace gnomon::shadow_fit
