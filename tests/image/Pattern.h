#pragma once

#include <gnomon/image/Image.h>

namespace gnomon::image {

/// An image in which every channel of every pixel differs from its neighbours'.
inline Image pattern(int width, int height, int channels) {
    Image image = blank(width, height, channels);
    std::uint32_t state = 12345;
    for (auto& value : image.pixels) {
        state = state * 1664525U + 1013904223U;
        value = static_cast<std::uint8_t>(state >> 24U);
    }
    return image;
}

}  // namespace gnomon::image
