#pragma once

#include "Plain.h"

namespace gnomon::shadow_fit {

/// The map of the light's plane with the least expected error, among all that have their
/// perspective along some direction: w grows linearly from 1 where the outline begins. A direction
/// and a strength are searched for from a guess; which parallelogram of what they make becomes the
/// square is known then.
///
/// Sides of a texel add up over the picture to a norm of the parallelogram's sides. In the space
/// where that norm is a length the best one is that of the least perimeter around the outline, and
/// has a side on an edge of it.
///
/// Nothing where not even the guess is a map.
std::optional<math::dmat3> bestWarp(const Ground& ground, const Warp& guess, int mapSize,
                                    std::span<const Sample> samples);

}  // namespace gnomon::shadow_fit
