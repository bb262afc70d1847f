#pragma once

#include <span>

#include "LightPlane.h"

/// Projective maps of a light's plane: how a shadow map's texels lie over what is seen.
namespace gnomon::shadow_fit {

/// The smallest rectangle around the outline, turned as it lies best. Source: Herbert Freeman, Ruth
/// Shapira. Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed Curve. 1975.
math::dmat3 uniformMap(std::span<const math::dvec2> hull, int mapSize);

/// A perspective along @p along (unit): w grows linearly from 1 where the outline begins to
/// 1 + @p strength where it ends. Strength 0 has no perspective. Lines through the vanishing point,
/// which lies extent / strength before the outline at @p beside across it, become the map's
/// columns.
struct Warp {
    math::dvec2 along{0.0, 1.0};
    double strength = 0.0;
    double beside = 0.0;
};
/// Nothing where the numbers are beyond doubles.
std::optional<math::dmat3> warpedMap(std::span<const math::dvec2> hull, const Warp& warp,
                                     int mapSize);

/// Any projective map, cropped to the outline and scaled so that w is 1 at the least.
/// @pre w > 0 on the whole outline; else nothing.
std::optional<math::dmat3> croppedMap(std::span<const math::dvec2> hull,
                                      const math::dmat3& mapFromPlane, int mapSize);

/// Where the outline begins and ends along a direction.
struct Extent {
    double low = 0.0, high = 0.0;
    double length() const noexcept { return high - low; }
};
Extent extentAlong(std::span<const math::dvec2> hull, const math::dvec2& along) noexcept;

/// What a map is expected to get wrong: the mean side of a texel, in metres across the light, over
/// equal shares of the picture by their weight. The length of shadow edges in a share of the
/// picture times their displacement is the share that is wrong, whatever its distance.
double expectedError(const LightPlane& plane, const math::dmat3& mapFromPlane, int mapSize,
                     std::span<const Sample> samples);

}  // namespace gnomon::shadow_fit
