// Light space perspective shadow maps: a perspective across the light's rays, along the view, gives
// what is near more texels.
// Michael Wimmer, Daniel Scherzer, Werner Purgathofer. Light Space Perspective Shadow Maps. 2004.
// General light directions: the same. Robust Shadow Mapping with Light Space Perspective Shadow
// Maps. ShaderX4, 2006.
//
// Where we depart from them: the perspective is a map of the light's plane alone, so that depth is
// as without it; near and far are those of what is really seen; and where the expected error is not
// below the plain map's (the light along the view), the plain map is used and marked.
#include <algorithm>
#include <cmath>

#include "../../fit/src/BestWarp.h"

namespace gnomon::shadow_fit {
namespace {

using math::dvec2;
using math::dvec3;

Fitted fit(const FitInput& input) {
    if (input.receivers.empty()) return {};
    const Ground ground{input};
    const auto viewer = viewerOf(input);
    if (!viewer || ground.outline.atLight) return ground.plain(true);

    dvec3 middle{0.0};
    for (const dvec3& p : input.receivers.points())
        middle += p / static_cast<double>(input.receivers.points().size());
    const dvec2 shift = ground.plane.moved(middle, viewer->forward);
    if (!(glm::length(shift) > 0.0) || !std::isfinite(glm::length(shift)))
        return ground.plain(true);
    const dvec2 along = glm::normalize(shift);
    // n = d / (sqrt(z1 / z0) - 1) for an extent d of the outline, that is seen from z0 to z1.
    // The root less 1, without cancellation where both depths are about the same.
    const double root = std::sqrt(viewer->farthest / viewer->nearest);
    const double strength = (viewer->farthest - viewer->nearest) / viewer->nearest / (root + 1.0);
    const auto warped =
        bestWarp(ground, {.along = along, .strength = strength}, input.mapSize, input.samples);
    if (!warped) return ground.plain(true);
    const auto expected = [&](const math::dmat3& map) {
        return expectedError(ground.plane, map, input.mapSize, input.samples);
    };
    if (!input.samples.empty() && !(expected(*warped) < expected(ground.uniform)))
        return ground.plain(true);
    return {.maps = {{.clipFromWorld = ground.clipFromWorld(*warped)}}};
}

}  // namespace

FitInfo describe_lispsm() {
    return {.name = "lispsm",
            .source = "Wimmer, Scherzer, Purgathofer 2004",
            .fit = fit,
            .shadowedOnly = true,
            .sampled = true};
}

}  // namespace gnomon::shadow_fit
