#pragma once

#include "PlaneMap.h"

namespace gnomon::shadow_fit {

/// What every fit begins with: the light's plane, the outline of the receivers on it, depths.
struct Ground {
    explicit Ground(const FitInput& input);

    math::dmat4 clipFromWorld(const math::dmat3& mapFromPlane) const {
        return plane.clipFromWorld(mapFromPlane, depth);
    }

    Fitted plain(bool degenerate) const {
        return {.maps = {{.clipFromWorld = clipFromWorld(uniform)}}, .degenerate = degenerate};
    }

    LightPlane plane;
    Outline outline;
    LightPlane::Depth depth;
    math::dmat3 uniform{1.0};  ///< the plain map of it
};

/// The map without any warp: what the others fall back to.
Fitted plainFit(const FitInput& input);

/// The middle of the views: where the fits that favour what is near look from.
struct Viewer {
    math::dvec3 eye{0.0};
    math::dvec3 forward{0.0, 0.0, -1.0};  ///< unit
    /// Depth of the receivers along forward, metres; nearest > 0.
    double nearest = 0.0, farthest = 0.0;

    double depthOf(const math::dvec3& p) const noexcept { return glm::dot(p - eye, forward); }
};
/// Nothing where there is no view to look from or no receiver in front of it.
std::optional<Viewer> viewerOf(const FitInput& input);

}  // namespace gnomon::shadow_fit
