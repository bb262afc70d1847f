#pragma once

#include <gnomon/shadow_fit/Fit.h>

#include <span>

namespace gnomon::shadow_fit {

/// Parallel light: the smallest rectangle around the receivers, deep enough for all casters.
math::dmat4 parallelCamera(const FitInput& input, std::span<const math::dvec3> receivers);

/// Spot: the cone's frustum, cut to the receivers.
math::dmat4 spotCamera(const FitInput& input, std::span<const math::dvec3> receivers);

/// The frustum of a spot's whole cone, without regard to receivers.
math::dmat4 coneCamera(const LightShape& light, double near, double far);

}  // namespace gnomon::shadow_fit
