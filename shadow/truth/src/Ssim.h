#pragma once

#include "Blur.h"

namespace gnomon::truth {

/// Structural similarity of two images of values 0 to 1, for each pixel. Gaussian window of 1.5
/// pixels. Source: Zhou Wang, Alan Bovik, Hamid Sheikh, Eero Simoncelli. Image Quality Assessment.
/// 2004.
Plane ssim(const Plane& a, const Plane& b);

}  // namespace gnomon::truth
