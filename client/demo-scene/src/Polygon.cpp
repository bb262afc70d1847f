// Source: Gary Meisters. Polygons Have Ears. The American Mathematical Monthly 82, 1975
#include "Polygon.h"

#include <gnomon/base/Error.h>

#include <glm/common.hpp>
#include <numeric>

namespace gnomon::demo {
namespace {

/// Twice the signed area of abc, in doubles, so that thin ears keep their sign.
double cross(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    return (double{b.x} - double{a.x}) * (double{c.y} - double{a.y}) -
           (double{b.y} - double{a.y}) * (double{c.x} - double{a.x});
}

bool contains(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 p) {
    return cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
}

/// Smallest corner angle measure: 1 for needle-free ears, near 0 for needles.
double quality(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    const glm::vec2 ab = b - a;
    const glm::vec2 bc = c - b;
    const glm::vec2 ca = a - c;
    const double sum = double{ab.x * ab.x + ab.y * ab.y} + double{bc.x * bc.x + bc.y * bc.y} +
                       double{ca.x * ca.x + ca.y * ca.y};
    return sum > 0.0 ? cross(a, b, c) / sum : 0.0;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const glm::vec2> outline) {
    GNOMON_EXPECTS(outline.size() >= 3, "a polygon has three corners");
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
        area += cross(outline[0], outline[i], outline[i + 1]);
    }
    GNOMON_EXPECTS(area > 0.0, "an outline is counter-clockwise");
    std::vector<std::uint32_t> left(outline.size());
    std::iota(left.begin(), left.end(), 0U);
    std::vector<std::array<std::uint32_t, 3>> result;
    while (left.size() > 3) {
        std::size_t best = left.size();
        double bestQuality = 0.0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const glm::vec2 a = outline[left[(i + left.size() - 1) % left.size()]];
            const glm::vec2 b = outline[left[i]];
            const glm::vec2 c = outline[left[(i + 1) % left.size()]];
            const double q = quality(a, b, c);
            if (q <= bestQuality) continue;
            bool isEar = true;
            for (const std::uint32_t other : left) {
                const glm::vec2 p = outline[other];
                if (p == a || p == b || p == c) continue;  // the corners, and a slit's other side
                if (contains(a, b, c, p)) {
                    isEar = false;
                    break;
                }
            }
            if (!isEar) continue;
            best = i;
            bestQuality = q;
        }
        GNOMON_EXPECTS(best < left.size(), "an outline does not cross itself");
        result.push_back({left[(best + left.size() - 1) % left.size()], left[best],
                          left[(best + 1) % left.size()]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    result.push_back({left[0], left[1], left[2]});
    return result;
}

}  // namespace gnomon::demo
