#pragma once

#include "Blur.h"

namespace gnomon::truth {

/// FLIP of two grey images (sRGB values 0 to 1), for each pixel: 0 alike, 1 as different as can be.
/// What a person sees who alternates between them at @p pixelsPerDegree.
/// Source: Pontus Andersson, Jim Nilsson, Tomas Akenine-Moeller, Magnus Oskarsson, Kalle Astroem,
/// Mark Fairchild. FLIP: A Difference Evaluator for Alternating Images. 2020. The colour channels
/// are left out: grey has none.
Plane flip(const Plane& reference, const Plane& test, float pixelsPerDegree = 67.0F);

}  // namespace gnomon::truth
