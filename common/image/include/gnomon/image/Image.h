#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::image {

/// Pixels of 8 bits a channel, top row first, rows without padding. Channels are grey, red green
/// blue, or red green blue alpha; colours are sRGB, alpha is not multiplied in.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;  ///< 1, 3 or 4
    std::vector<std::uint8_t> pixels = {};

    bool operator==(const Image&) const = default;
};

/// An image of zeros. @pre As isSound().
Image blank(int width, int height, int channels);

/// What readers accept and writers expect: each side 1 to 65535, at most maxBytes of pixels, a
/// known number of channels, and as many bytes as these make.
bool isSound(const Image& image) noexcept;

constexpr int maxSide = 65535;                           // pixels
constexpr std::size_t maxBytes = std::size_t{1} << 30U;  // a picture of 16384 x 16384, RGBA

}  // namespace gnomon::image
