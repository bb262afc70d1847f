// Perspective shadow maps: the map is drawn in the view's post-perspective space, where what is
// near is large. Marc Stamminger, George Drettakis. Perspective Shadow Maps. 2002. The virtual
// camera that is slid back until the light works: Simon Kozlov. Perspective Shadow Maps: Care and
// Feeding. GPU Gems, 2004.
//
// Where we depart from them: of the post-perspective light camera only what it does to the light's
// plane is kept. Depth is the light's own, so that a light behind the eye needs no reversed test,
// and casters behind the eye are on their rays as all others are.
#include <algorithm>
#include <cmath>

#include "../../fit/src/Plain.h"

namespace gnomon::shadow_fit {
namespace {

using math::dmat3;
using math::dmat4;
using math::dvec2;
using math::dvec3;
using math::dvec4;

/// How far the post-perspective light must be from what is seen, in radii of it. Nearer, its own
/// perspective undoes the view's.
constexpr double leastDistance = 1.5;

/// The virtual camera's view of the receivers: a frustum just around them.
dmat4 clipFromWorldOf(const FitInput& input, const Viewer& viewer, double shift) {
    const dvec3 eye = viewer.eye - viewer.forward * shift;
    const auto [u, v] = perpendicular(-viewer.forward);
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
    for (const dvec3& p : input.receivers.points()) {
        const dvec3 way = p - eye;
        const double depth = glm::dot(way, viewer.forward);  // >= nearest + shift > 0
        left = std::min(left, glm::dot(way, u) / depth);
        right = std::max(right, glm::dot(way, u) / depth);
        bottom = std::min(bottom, glm::dot(way, v) / depth);
        top = std::max(top, glm::dot(way, v) / depth);
    }
    const double least = 1e-6;
    right = std::max(right, left + least);
    top = std::max(top, bottom + least);
    const double near = viewer.nearest + shift;
    const double far = std::max(viewer.farthest + shift, near * (1.0 + 1e-6));
    return math::frustum(left, right, bottom, top, near, far) *
           math::lookAt(eye, eye + viewer.forward, v);
}

/// What the light camera in the virtual camera's clip space does to the light's plane; nothing
/// where the light is too near to what is seen.
std::optional<dmat3> mapAt(const FitInput& input, const Ground& ground, const Viewer& viewer,
                           double shift) {
    const dmat4 clip = clipFromWorldOf(input, viewer, shift);
    const dvec4 light = clip * (ground.plane.parallel() ? dvec4{ground.plane.toward(), 0.0}
                                                        : dvec4{input.light.position, 1.0});
    dvec3 middle{0.0};
    double radius = 0.0;
    std::vector<dvec3> seen;
    for (const dvec3& p : input.receivers.points()) {
        const dvec4 q = clip * dvec4{p, 1.0};
        seen.push_back(dvec3{q} / q.w);
        middle += seen.back();
    }
    middle /= static_cast<double>(seen.size());
    for (const dvec3& q : seen) radius = std::max(radius, glm::length(q - middle));
    // Toward the light from the middle: light / w - middle, without the division by a w that may be
    // zero (then the light is parallel here too).
    const double sign = light.w < 0.0 ? -1.0 : 1.0;
    const dvec3 way = (dvec3{light} - middle * light.w) * sign;
    const double far = glm::length(way);
    if (!(far > leastDistance * radius * std::abs(light.w)) || !(far > 0.0)) return {};
    const dvec3 axis = -way / far;
    // The view's depth goes up the map.
    dvec3 up = dvec3{0.0, 0.0, -1.0};
    up -= axis * glm::dot(up, axis);
    if (!(glm::length(up) > 1e-3)) up = dvec3{0.0, 1.0, 0.0} - axis * axis.y;
    up = glm::normalize(up);
    const dvec3 right = glm::cross(up, axis);

    // Rows (q - light) . direction, times all ws: they vanish on the light's rays, so they are maps
    // of its plane.
    const double scale = 1.0 / far;
    const dmat4 rows = glm::transpose(clip);
    const auto along = [&](const dvec3& direction) {
        const dvec4 q = rows[0] * direction.x + rows[1] * direction.y + rows[2] * direction.z;
        return (q * light.w - rows[3] * glm::dot(dvec3{light}, direction)) * (sign * scale);
    };
    const auto [u, v] = perpendicular(ground.plane.toward());
    const auto planeRow = [&](const dvec4& f) {
        const dvec3 d{f};
        // Of a spot the plane's w is along its axis; of parallel light it is the constant.
        return dvec3{glm::dot(d, u), glm::dot(d, v),
                     ground.plane.parallel() ? f.w : -glm::dot(d, ground.plane.toward())};
    };
    const dmat3 transposed{planeRow(along(right)), planeRow(along(up)), planeRow(along(axis))};
    return glm::transpose(transposed);
}

Fitted fit(const FitInput& input) {
    if (input.receivers.empty()) return {};
    const Ground ground{input};
    const auto viewer = viewerOf(input);
    if (!viewer || ground.outline.atLight) return ground.plain(true);
    const double range = std::max(viewer->farthest - viewer->nearest, 1e-6 * viewer->farthest);
    // Not at all, then from a 32nd of the range to 32 times it.
    for (int step = 0; step < 12; ++step) {
        const double shift = step == 0 ? 0.0 : std::ldexp(range, step - 6);
        const auto map = mapAt(input, ground, *viewer, shift);
        if (!map) continue;
        if (const auto cropped = croppedMap(ground.outline.hull, *map, input.mapSize))
            return {.maps = {{.clipFromWorld = ground.clipFromWorld(*cropped)}}};
    }
    return ground.plain(true);
}

}  // namespace

FitInfo describe_psm() {
    return {.name = "psm",
            .source = "Stamminger, Drettakis 2002; Kozlov 2004",
            .fit = fit,
            .shadowedOnly = true};
}

}  // namespace gnomon::shadow_fit
