#pragma once

#include <vector>

namespace gnomon::truth {

/// One channel of floats.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values = {};

    float& at(int x, int y) { return values[index(x, y)]; }
    float at(int x, int y) const { return values[index(x, y)]; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

/// Convolves rows with one kernel and columns with another, both of odd length; beyond the border
/// the nearest pixel is repeated.
Plane separable(const Plane& from, const std::vector<float>& rows,
                const std::vector<float>& columns);

}  // namespace gnomon::truth
