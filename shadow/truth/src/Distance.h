#pragma once

#include <vector>

namespace gnomon::truth {

/// Distance in pixels from each pixel to the nearest marked one, exact; infinite where none is.
/// Source: Pedro Felzenszwalb, Daniel Huttenlocher. Distance Transforms of Sampled Functions. 2012.
std::vector<float> distanceTo(const std::vector<bool>& marked, int width, int height);

}  // namespace gnomon::truth
