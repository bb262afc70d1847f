#include "Plain.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow_fit {

using math::dvec3;

Ground::Ground(const FitInput& input)
    : plane{input.light},
      outline{outlineOf(plane, input.light, input.receivers.points(), input.reach)},
      depth{plane.depthOf(input.receivers.points(), input.scene)},
      uniform{uniformMap(outline.hull, input.mapSize)} {
    // What is looked up around a receiver lies on its plane, which goes on: as steep as this.
    constexpr double slope = 4.0;
    depth.farthest += slope * input.reach * (plane.parallel() ? 1.0 : depth.farthest);
}

Fitted plainFit(const FitInput& input) {
    if (input.receivers.empty()) return {};
    const Ground ground{input};
    return {.maps = {{.clipFromWorld = ground.clipFromWorld(ground.uniform)}}};
}

std::optional<Viewer> viewerOf(const FitInput& input) {
    Viewer viewer{.forward = dvec3{0.0}};
    double views = 0.0;
    for (const math::View& view : input.views) {
        if (!math::isFinite(view.clipFromWorld())) continue;
        viewer.eye += view.eyeWorld();
        viewer.forward -= dvec3{glm::transpose(view.eyeFromWorld)[2]};
        views += 1.0;
    }
    const double length = glm::length(viewer.forward);
    if (!(views > 0.0) || !(length > 1e-6 * views)) return {};
    viewer.eye /= views;
    viewer.forward /= length;
    viewer.nearest = std::numeric_limits<double>::infinity();
    viewer.farthest = -viewer.nearest;
    for (const dvec3& p : input.receivers.points()) {
        viewer.nearest = std::min(viewer.nearest, viewer.depthOf(p));
        viewer.farthest = std::max(viewer.farthest, viewer.depthOf(p));
    }
    // Nearer than what rounding does to the farthest, depths say nothing.
    if (!(viewer.nearest > 1e-15 * viewer.farthest) || !std::isfinite(viewer.farthest)) return {};
    if (!(viewer.nearest > narrowestMap)) return {};
    return viewer;
}

}  // namespace gnomon::shadow_fit
