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
                   std::span<const math::dvec3> receivers, const math::Box& casters) {
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
    const auto depth = plane.depthOf(receivers, casters);
    if (plane.parallel()) {
        if (spread == Spread::fixed) return softness;
        // Nothing casts from farther away than a ray is in the bounds.
        double away = depth.farthest - depth.nearest;
        const math::dvec3 size = casters.empty() ? math::dvec3{0.0} : casters.size();
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
    double caster = depth.farthest;
    if (!casters.empty())
        for (int i = 0; i < 8; ++i) caster = std::min(caster, plane.at(casters.corner(i)).z);
    caster = std::clamp(caster, depth.nearest, depth.farthest);
    return std::min(extentOf(light) * (1.0 / caster - 1.0 / depth.farthest), mostTangents);
}

}  // namespace gnomon::shadow_fit
