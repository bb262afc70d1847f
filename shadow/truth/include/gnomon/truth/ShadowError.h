#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/image/Image.h>

#include <cstdint>

namespace gnomon::truth {

/// How far a shadow factor image is from the truth, over the pixels the truth counts (not 128).
struct ShadowError {
    std::uint64_t counted = 0;
    /// On different sides of 127.5.
    std::uint64_t wrong = 0;
    std::uint64_t falseShadow = 0;
    std::uint64_t falseLight = 0;
    std::uint64_t nearEdge = 0;  ///< of the wrong ones, within two pixels of an edge of the truth
    std::uint64_t interior = 0;  ///< and the others: acne, leaks, lost shadows
    std::uint64_t holes = 0;     ///< counted pixels where the image has no surface
    double rmse = 0.0;           ///< of the factor, 0 to 1
    /// From each pixel of the truth's shadow edges to the image's nearest one, pixels; at most 16.
    double edgeMean = 0.0;
    double edge95 = 0.0;
    double ssim = 1.0;  ///< structural similarity, mean over counted pixels
    double flip = 0.0;  ///< FLIP, mean over counted pixels, at 67 pixels a degree

    double share(std::uint64_t pixels) const noexcept {
        return counted == 0 ? 0.0 : static_cast<double>(pixels) / static_cast<double>(counted);
    }
};

/// Errors (Errc::limit): the images differ in size, or have more than one channel.
Result<ShadowError> compareFactors(const image::Image& truth, const image::Image& factor);

/// To look at: the truth in grey, false shadow red, false light blue.
/// @pre As compareFactors().
image::Image errorPicture(const image::Image& truth, const image::Image& factor);

}  // namespace gnomon::truth
