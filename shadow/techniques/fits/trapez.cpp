// Trapezoidal shadow maps: the view volume, as the light sees it, is enclosed in a trapezoid whose
// front part fills four fifths of the map.
// Tobias Martin, Tiow-Seng Tan. Anti-aliasing and Continuity with Trapezoidal Shadow Maps. 2004.
// Nico Hempe. Diploma thesis on the OpenSG ShadowViewport. 2005, sections 6.2 and 6.3.
//
// The thesis' improvements: where the light sees the eye inside the far plane the view volume has
// no trapezoid, and the plain map is taken (6.3.1: there the far plane; the outline of the
// receivers is within it) - unless the receivers have one that is expected to err less. Base and
// top line come from what is really seen (6.3.2). Sides that open too wide move the point they
// start from back (6.3.3). Depth is not distorted: the perspective is a map of the light's plane
// alone (6.3.4). Where we depart from them: base and top line touch the receivers, not the view
// volume's corners; and the pole of the 80 % rule at 0.8 (a focus beyond it turns the trapezoid
// over) is kept away from.
#include <algorithm>
#include <cmath>

#include "../../fit/src/Plain.h"

namespace gnomon::shadow_fit {
namespace {

using math::dvec2;
using math::dvec3;

/// The widest angle between the trapezoid's sides, as the tangent of its half: 120 degrees.
constexpr double widestHalf = 1.7320508075688772;
/// Where in the map, from -1 to 1, the focus region ends: four fifths of it from the front.
constexpr double focusLine = -0.6;

/// The light sees the eye among the far plane's corners: looking along the light, or against it.
bool insideFarPlane(const FitInput& input, const LightPlane& plane, const Viewer& viewer) {
    std::vector<dvec2> corners;
    for (const math::View& view : input.views) {
        if (!math::isFinite(view.clipFromWorld())) continue;
        const auto all = math::frustumCorners(view.clipFromWorld());
        for (std::size_t i = 4; i < 8; ++i) {
            // As far as anything is seen.
            const dvec3 way = all[i] - viewer.eye;
            const double depth = glm::dot(way, viewer.forward);
            if (!(depth > 0.0)) return true;  // nor where the far plane is infinitely far away
            const dvec3 h = plane.at(viewer.eye + way * (viewer.farthest / depth));
            if (!(h.z > 0.0)) return true;
            corners.push_back(dvec2{h} / h.z);
        }
    }
    const dvec3 eye = plane.at(viewer.eye);
    if (!(eye.z > 0.0)) return true;
    const dvec2 p = dvec2{eye} / eye.z;
    const auto hull = convexHull(std::move(corners));
    if (hull.size() < 3) return false;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const dvec2 to = p - hull[i];
        if (edge.x * to.y - edge.y * to.x < 0.0) return false;
    }
    return true;
}

Fitted fit(const FitInput& input) {
    if (input.receivers.empty()) return {};
    const Ground ground{input};
    const auto viewer = viewerOf(input);
    if (!viewer || ground.outline.atLight) return ground.plain(true);

    // The middle line: through the middles of the planes where what is seen begins and ends.
    const auto onMiddle = [&](double depth) {
        const dvec3 h = ground.plane.at(viewer->eye + viewer->forward * depth);
        return h.z > 0.0 ? std::optional{dvec2{h} / h.z} : std::nullopt;
    };
    const double depth = viewer->farthest - viewer->nearest;
    const auto near = onMiddle(viewer->nearest);
    const auto far = onMiddle(viewer->farthest);
    const auto focus =
        onMiddle(viewer->nearest + std::clamp(input.settings.range, 0.0, 1.0) * depth);
    if (!near || !far || !focus || !(glm::length(*far - *near) > 0.0)) return ground.plain(true);
    const dvec2 along = glm::normalize(*far - *near);
    const dvec2 across{along.y, -along.x};
    const double beside = glm::dot(*near, across);

    const auto& hull = ground.outline.hull;
    const Extent extent = extentAlong(hull, along);
    const double lambda = extent.length();
    // So narrow, or beyond doubles: no trapezoid. lambda divides below, as does what is never less
    // than a tenth of it.
    if (!(lambda > narrowestMap) || !std::isfinite(lambda)) return ground.plain(true);
    const double delta =
        std::clamp(glm::dot(*focus, along) - extent.low, 0.05 * lambda, 0.75 * lambda);
    double eta = lambda * delta * (1.0 + focusLine) / (lambda - 2.0 * delta - lambda * focusLine);
    for (const dvec2& p : hull) {
        const double aside = std::abs(glm::dot(p, across) - beside);
        eta = std::max(eta, aside / widestHalf - (glm::dot(p, along) - extent.low));
    }
    const Warp warp{.along = along, .strength = lambda / eta, .beside = beside};
    const auto trapezoid = warpedMap(hull, warp, input.mapSize);
    const auto expected = [&](const math::dmat3& map) {
        return expectedError(ground.plane, map, input.mapSize, input.samples);
    };
    if (!trapezoid) return ground.plain(true);
    if (insideFarPlane(input, ground.plane, *viewer) &&
        (input.samples.empty() || !(expected(*trapezoid) < expected(ground.uniform))))
        return ground.plain(true);
    return {.maps = {{.clipFromWorld = ground.clipFromWorld(*trapezoid)}}};
}

}  // namespace

FitInfo describe_trapez() {
    return {.name = "trapez",
            .source = "Martin, Tan 2004; Hempe 2005",
            .fit = fit,
            .shadowedOnly = true,
            .sampled = true};
}

}  // namespace gnomon::shadow_fit
