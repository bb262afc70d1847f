#pragma once

#include <gnomon/demo/Image.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

/// What the texture painters share.
namespace gnomon::demo {

/// One point of a surface.
struct Texel {
    glm::vec3 colour{1.0F};  ///< sRGB-encoded, 0 to 1
    float height = 0.0F;     ///< in texels, for the normal map
};

/// u, v in [0, 1), v downwards.
using Surface = std::function<Texel(float u, float v)>;

/// The colours and the heights of @p surface, @p size texels a side.
struct Painted {
    Image colour = {};
    std::vector<float> heights = {};
};
Painted painted(const std::string& name, std::uint32_t size, const Surface& surface);

/// Slopes of a height field that wraps on all sides.
Image normalMap(const std::string& name, std::uint32_t size, const std::vector<float>& heights);

/// 0 below @p low, 1 above @p high, smooth between.
inline float ramp(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

inline std::uint8_t toByte(float x) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0F, 1.0F) * 255.0F));
}

}  // namespace gnomon::demo
