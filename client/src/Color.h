#pragma once

#include <gnomon/math/Types.h>

#include <array>
#include <cmath>

namespace gnomon::client {

/// IEC 61966-2-1, the sRGB transfer curve; 0..1.
inline float linearFromSrgb(double value) noexcept {
    return static_cast<float>(value <= 0.04045 ? value / 12.92
                                               : std::pow((value + 0.055) / 1.055, 2.4));
}

inline math::vec3 linearFromSrgb(const std::array<double, 3>& color) noexcept {
    return {linearFromSrgb(color[0]), linearFromSrgb(color[1]), linearFromSrgb(color[2])};
}

}  // namespace gnomon::client
