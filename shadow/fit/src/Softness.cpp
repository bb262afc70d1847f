#include <gnomon/math/ConvexBody.h>
#include <gnomon/shadow_fit/Softness.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "LightPlane.h"

namespace gnomon::shadow_fit {
namespace {

/// What blurs whole maps knows nothing beyond a page.
constexpr int largePage = 4096;
constexpr std::array<FilterUse, 11> uses{{{"hard", Spread::none},
                                          {"gauss", Spread::fixed, shadow_fit::pageTexels, 1.8},
                                          {"pcf", Spread::fixed},
                                          {"rotated", Spread::fixed},
                                          {"hardware", Spread::fixed},
                                          {"ppcf", Spread::penumbra},
                                          {"square", Spread::texels},
                                          {"vsm", Spread::fixed, largePage, 3.0},
                                          {"evsm", Spread::fixed, largePage, 3.0},
                                          {"vsm16", Spread::fixed, largePage, 3.0},
                                          {"evsm16", Spread::fixed, largePage, 3.0}}};

/// A lookup that goes further than this many tangents around would see half the world.
constexpr double mostTangents = 2.0;

/// How near to a light, along its axis, something comes that may shadow the receivers from any part
/// of it.
double nearestCaster(const LightPlane& plane, const LightShape& light,
                     std::span<const math::dvec3> receivers, const math::BoxTree& casters,
                     const LightPlane::Depth& depth) {
    const auto hull = outlineOf(plane, light, receivers, 0.0).hull;
    if (hull.empty()) return depth.nearest;
    math::dvec2 low = hull.front();
    math::dvec2 high = low;
    for (const math::dvec2& p : hull) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    std::array sides{plane.through({1.0, 0.0, -low.x}), plane.through({-1.0, 0.0, high.x}),
                     plane.through({0.0, 1.0, -low.y}), plane.through({0.0, -1.0, high.y})};
    // From a receiver to the light's rim a ray leaves them by the light's radius at the most.
    for (math::Plane& side : sides) side.offset += extentOf(light);
    const auto begins = [&](const math::Box& box) {
        double near = depth.farthest;
        for (int i = 0; i < 8; ++i) near = std::min(near, plane.at(box.corner(i)).z);
        return std::max(near, depth.nearest);
    };
    double nearest = depth.farthest;
    math::ConvexBody body;
    // Of a large box, the ground's, the part between the light and the receivers alone.
    const auto between = [&](const math::Box& box) {
        if (begins(box) >= nearest) return nearest;
        body.assign(box);
        for (const math::Plane& side : sides) body.clip(side);
        double near = nearest;
        for (const math::dvec3& p : body.points()) near = std::min(near, plane.at(p).z);
        return std::max(near, depth.nearest);
    };
    casters.cover(
        sides, [&](const math::Box& box) { return begins(box) >= nearest; },
        [&](const math::Box& box, bool) { nearest = between(box); });
    return nearest;
}

}  // namespace

std::span<const FilterUse> filterUses() noexcept { return uses; }

const FilterUse* findFilterUse(std::string_view name) noexcept {
    const auto* found =
        std::find_if(uses.begin(), uses.end(), [&](const auto& use) { return use.name == name; });
    return found == uses.end() ? nullptr : found;
}

double extentOf(const LightShape& light) noexcept {
    return light.kind == LightKind::directional ? std::tan(std::clamp(light.extent, 0.0, 1.5))
                                                : std::max(light.extent, 0.0);
}

double softnessOf(const LightShape& light) noexcept {
    constexpr double metresAway = 10.0;
    const double extent = extentOf(light);
    return std::max(0.05,
                    light.kind == LightKind::directional ? extent * metresAway : extent * 0.5);
}

double lookupReach(const FilterUse& filter, const LightShape& light, double softness, double share,
                   std::span<const math::dvec3> receivers, const math::BoxTree& casters) {
    const Spread spread = filter.spread;
    if (spread == Spread::none || receivers.empty()) return 0.0;
    softness *= filter.tails;
    const LightPlane plane{light};
    if (spread == Spread::texels) {
        const auto hull = outlineOf(plane, light, receivers, 0.0).hull;
        math::Box seen;
        for (const math::dvec2& p : hull) seen.add(math::dvec3{p, 0.0});
        return hull.empty() ? 0.0 : 1.5 * share * glm::length(seen.size());
    }
    const math::Box bounds = casters.bounds();
    const auto depth = plane.depthOf(receivers, bounds);
    if (plane.parallel()) {
        if (spread == Spread::fixed) return softness;
        // Nothing casts from farther away than a ray is in the bounds.
        double away = depth.farthest - depth.nearest;
        const math::dvec3 size = bounds.empty() ? math::dvec3{0.0} : bounds.size();
        for (int i = 0; i < 3; ++i) {
            const double slope = std::abs(light.direction[i]);
            if (slope * away > size[i]) away = size[i] / slope;
        }
        return extentOf(light) * away;
    }
    double nearest = depth.farthest;
    for (const math::dvec3& p : receivers) nearest = std::min(nearest, plane.at(p).z);
    nearest = std::max(nearest, depth.nearest);
    if (spread == Spread::fixed) return std::min(softness / nearest, mostTangents);
    // What is nearer than the map's near side is drawn there.
    const double caster = nearestCaster(plane, light, receivers, casters, depth);
    const double most = extentOf(light) * (1.0 / caster - 1.0 / depth.farthest);
    // In steps: a map does not change whenever something moves a little.
    return most > 0.0 ? std::min(std::exp2(std::ceil(8.0 * std::log2(most)) / 8.0), mostTangents)
                      : 0.0;
}

}  // namespace gnomon::shadow_fit
