#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::demo {

/// RGBA pixels, 8 bits a channel, top row first. Colour is sRGB-encoded; normal maps are linear.
struct Image {
    std::string name = {};
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> pixels = {};

    Image() = default;
    Image(std::string imageName, std::uint32_t imageWidth, std::uint32_t imageHeight)
        : name{std::move(imageName)},
          width{imageWidth},
          height{imageHeight},
          pixels(std::size_t{imageWidth} * imageHeight * 4, 255) {}

    std::uint8_t* at(std::uint32_t x, std::uint32_t y) {
        return &pixels[(std::size_t{y} * width + x) * 4];
    }
    const std::uint8_t* at(std::uint32_t x, std::uint32_t y) const {
        return &pixels[(std::size_t{y} * width + x) * 4];
    }
};

/// A PNG file; without an alpha channel where every pixel is opaque.
/// @throws Failure file, when libpng refuses.
std::vector<std::uint8_t> encodePng(const Image& image);

}  // namespace gnomon::demo
