#include "Blur.h"

#include <algorithm>

namespace gnomon::truth {

Plane separable(const Plane& from, const std::vector<float>& rows,
                const std::vector<float>& columns) {
    Plane along = from;
    const auto reachX = static_cast<int>(rows.size() / 2);
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            float sum = 0.0F;
            for (int k = -reachX; k <= reachX; ++k)
                sum += rows[static_cast<std::size_t>(k + reachX)] *
                       from.at(std::clamp(x + k, 0, from.width - 1), y);
            along.at(x, y) = sum;
        }
    }
    Plane done = from;
    const auto reachY = static_cast<int>(columns.size() / 2);
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            float sum = 0.0F;
            for (int k = -reachY; k <= reachY; ++k)
                sum += columns[static_cast<std::size_t>(k + reachY)] *
                       along.at(x, std::clamp(y + k, 0, from.height - 1));
            done.at(x, y) = sum;
        }
    }
    return done;
}

}  // namespace gnomon::truth
