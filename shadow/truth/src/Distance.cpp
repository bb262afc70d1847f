#include "Distance.h"

#include <cmath>
#include <limits>

namespace gnomon::truth {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Lower envelope of parabolas on one line of squared distances, in place.
class Line {
public:
    explicit Line(std::size_t longest) : in_(longest), at_(longest), bounds_(longest + 1) {}

    void transform(float* values, std::size_t count, std::size_t stride) {
        for (std::size_t i = 0; i < count; ++i) in_[i] = values[i * stride];
        std::size_t used = 0;
        for (std::size_t q = 0; q < count; ++q) {
            if (in_[q] == infinite) continue;
            float from = -infinite;
            while (used > 0) {
                from = crossing(at_[used - 1], q);
                if (from > bounds_[used - 1]) break;
                --used;
                from = -infinite;
            }
            at_[used] = q;
            bounds_[used++] = from;
        }
        if (used == 0) return;
        std::size_t k = 0;
        for (std::size_t q = 0; q < count; ++q) {
            while (k + 1 < used && bounds_[k + 1] < static_cast<float>(q)) ++k;
            const float way = static_cast<float>(q) - static_cast<float>(at_[k]);
            values[q * stride] = way * way + in_[at_[k]];
        }
    }

private:
    /// Where the parabolas of p < q meet.
    float crossing(std::size_t p, std::size_t q) const {
        const auto a = static_cast<float>(p);
        const auto b = static_cast<float>(q);
        return ((in_[q] + b * b) - (in_[p] + a * a)) / (2.0F * (b - a));
    }
    std::vector<float> in_;
    std::vector<std::size_t> at_;
    std::vector<float> bounds_;
};

}  // namespace

std::vector<float> distanceTo(const std::vector<bool>& marked, int width, int height) {
    const auto w = static_cast<std::size_t>(width);
    const auto h = static_cast<std::size_t>(height);
    std::vector<float> distance(w * h, infinite);
    for (std::size_t i = 0; i < distance.size(); ++i)
        if (marked[i]) distance[i] = 0.0F;
    Line line{std::max(w, h)};
    for (std::size_t x = 0; x < w; ++x) line.transform(&distance[x], h, w);
    for (std::size_t y = 0; y < h; ++y) line.transform(&distance[y * w], w, 1);
    for (float& d : distance) d = std::sqrt(d);
    return distance;
}

}  // namespace gnomon::truth
