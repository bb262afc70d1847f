#pragma once

#include <gnomon/shadow_fit/Fit.h>

#include <span>
#include <utility>

namespace gnomon::shadow_fit {

/// Two unit vectors that with @p axis (unit) make a right-handed orthonormal base.
/// Source: Tom Duff et al. Building an Orthonormal Basis, Revisited. 2017.
std::pair<math::dvec3, math::dvec3> perpendicular(const math::dvec3& axis) noexcept;

/// Parallel light: the smallest rectangle around the receivers, deep enough for all casters.
math::dmat4 parallelCamera(const FitInput& input, std::span<const math::dvec3> receivers);

/// Spot: the cone's frustum, cut to the receivers.
math::dmat4 spotCamera(const FitInput& input, std::span<const math::dvec3> receivers);

/// The frustum of a spot's whole cone, without regard to receivers.
math::dmat4 coneCamera(const LightShape& light, double near, double far);

}  // namespace gnomon::shadow_fit
