#include <gnomon/shadow_fit/Softness.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "LightPlane.h"

namespace gnomon::shadow_fit {
namespace {

constexpr std::array<FilterUse, 5> uses{{{"hard", Spread::none},
                                         {"pcf", Spread::fixed},
                                         {"ppcf", Spread::penumbra},
                                         {"vsm", Spread::fixed},
                                         {"evsm", Spread::fixed}}};

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

double lookupReach(Spread spread, const LightShape& light, double softness,
                   std::span<const math::dvec3> receivers, const math::Box& casters) {
    if (spread == Spread::none || receivers.empty()) return 0.0;
    const LightPlane plane{light};
    const auto depth = plane.depthOf(receivers, casters);
    if (plane.parallel())
        return spread == Spread::fixed ? softness
                                       : extentOf(light) * (depth.farthest - depth.nearest);
    if (spread == Spread::fixed) {
        double nearest = depth.farthest;
        for (const math::dvec3& p : receivers) nearest = std::min(nearest, plane.at(p).z);
        return std::min(softness / std::max(nearest, depth.nearest), mostTangents);
    }
    // What is nearer than the map's near side is drawn there.
    double nearest = depth.farthest;
    if (!casters.empty())
        for (int i = 0; i < 8; ++i) nearest = std::min(nearest, plane.at(casters.corner(i)).z);
    nearest = std::max(nearest, depth.nearest);
    return std::min(extentOf(light) * (1.0 / nearest - 1.0 / depth.farthest), mostTangents);
}

}  // namespace gnomon::shadow_fit
