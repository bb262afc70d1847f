#include "Paint.h"

#include <glm/geometric.hpp>

namespace gnomon::demo {

Painted painted(const std::string& name, std::uint32_t size, const Surface& surface) {
    Painted result{.colour = Image{name, size, size}};
    result.heights.reserve(std::size_t{size} * size);
    const float step = 1.0F / static_cast<float>(size);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const Texel t = surface((static_cast<float>(x) + 0.5F) * step,
                                    (static_cast<float>(y) + 0.5F) * step);
            std::uint8_t* pixel = result.colour.at(x, y);
            pixel[0] = toByte(t.colour.x);
            pixel[1] = toByte(t.colour.y);
            pixel[2] = toByte(t.colour.z);
            result.heights.push_back(t.height);
        }
    }
    return result;
}

Image normalMap(const std::string& name, std::uint32_t size, const std::vector<float>& heights) {
    Image image{name, size, size};
    const auto height = [&](std::uint32_t x, std::uint32_t y) {
        return heights[std::size_t{y % size} * size + x % size];
    };
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const float dx = height(x + 1, y) - height(x + size - 1, y);
            const float down = height(x, y + 1) - height(x, y + size - 1);
            // The Y of a normal map points up, rows go down: the signs differ.
            const glm::vec3 n = glm::normalize(glm::vec3{-dx, down, 2.0F});
            std::uint8_t* pixel = image.at(x, y);
            pixel[0] = toByte(n.x * 0.5F + 0.5F);
            pixel[1] = toByte(n.y * 0.5F + 0.5F);
            pixel[2] = toByte(n.z * 0.5F + 0.5F);
        }
    }
    return image;
}

}  // namespace gnomon::demo
