#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/image/Image.h>

namespace gnomon::image {

struct Difference {
    /// Share of the pixels, 0 to 1, whose largest channel difference exceeds the threshold.
    double share = 0;
    int largest = 0;  ///< of all channels of all pixels, 0 to 255
    double mean = 0;  ///< of the absolute differences of all channels of all pixels
};

/// Errors (Errc::limit): the images differ in size or channels; both are named.
/// @pre Both images are sound.
Result<Difference> compare(const Image& a, const Image& b, int threshold);

/// Absolute differences times @p gain, cut at 255, to look at. Of RGBA images an RGB one, to which
/// alpha's difference is added: it would be invisible as transparency.
/// @pre Both images are sound and of the same size and channels; gain >= 1.
Image differenceImage(const Image& a, const Image& b, int gain = 1);

}  // namespace gnomon::image
