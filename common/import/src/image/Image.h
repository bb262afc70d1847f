#pragma once

#include <gnomon/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "input/Files.h"

namespace gnomon::importer {

/// Largest side in pixels, and largest decoded size, of an image that is accepted.
inline constexpr int maxImageSide = 16384;
inline constexpr std::uint64_t maxImageBytes = std::uint64_t{256} << 20U;

/// rgba8, top row first.
struct Image {
    int width = 0;
    int height = 0;
    bool hasAlpha = false;  ///< the file had an alpha channel
    Bytes pixels = {};
};

/// What an image file claims about itself; looks at its header only.
struct ImageHeader {
    int width = 0;
    int height = 0;
    std::uint64_t decodedBytes() const noexcept {
        return std::uint64_t{4} * static_cast<std::uint64_t>(width) *
               static_cast<std::uint64_t>(height);
    }
};

/// Errors: no PNG, JPEG, BMP or TGA, or larger than the limits above.
Result<ImageHeader> imageHeader(std::span<const std::byte> file);
/// Errors as imageHeader's, and broken data.
Result<Image> decodedImage(std::span<const std::byte> file);

/// Mean of each channel, 0..1.
struct ImageMean {
    double red = 0.0, green = 0.0, blue = 0.0;
};
ImageMean meanOf(const Image& image);

bool isGrey(const Image& image);
/// A tangent-space normal map (+y up) from a height map; @p scale heights a texel.
Image normalsFromHeights(const Image& heights, float scale);
/// Gives @p image the other one's alpha, or its brightness where that has none; nearest pixel where
/// sizes differ.
void putAlpha(Image& image, const Image& mask);

}  // namespace gnomon::importer
