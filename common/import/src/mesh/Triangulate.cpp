// Ear clipping. Gary Meisters. Polygons Have Ears. American Mathematical Monthly, 1975.
#include "mesh/Triangulate.h"

#include <algorithm>
#include <cmath>

namespace gnomon::importer {
namespace {

double cross(const math::dvec2& a, const math::dvec2& b, const math::dvec2& c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen against its normal (Newell's sum), so that it runs counter-clockwise.
std::vector<math::dvec2> flattened(std::span<const math::vec3> polygon) {
    math::dvec3 normal{0.0};
    const math::dvec3 origin{polygon[0]};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const math::dvec3 a = math::dvec3{polygon[i]} - origin;
        const math::dvec3 b = math::dvec3{polygon[(i + 1) % polygon.size()]} - origin;
        normal += glm::cross(a, b);
    }
    const math::dvec3 size = glm::abs(normal);
    int axis = 2;
    if (size.x >= size.y && size.x >= size.z)
        axis = 0;
    else if (size.y >= size.z)
        axis = 1;
    // Dropping the largest axis; the order of the other two keeps the winding.
    const int u = normal[axis] >= 0.0 ? (axis + 1) % 3 : (axis + 2) % 3;
    const int v = normal[axis] >= 0.0 ? (axis + 2) % 3 : (axis + 1) % 3;
    std::vector<math::dvec2> flat;
    for (const auto& p : polygon)
        flat.emplace_back(double{p[u]} - double{polygon[0][u]},
                          double{p[v]} - double{polygon[0][v]});
    return flat;
}

class EarClipper {
public:
    explicit EarClipper(std::vector<math::dvec2> points)
        : points_{std::move(points)}, next_(points_.size()), previous_(points_.size()) {
        const auto count = static_cast<std::uint32_t>(points_.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            next_[i] = (i + 1) % count;
            previous_[i] = (i + count - 1) % count;
        }
    }

    void run(std::vector<std::uint32_t>& out) {
        std::size_t left = points_.size();
        std::size_t tried = 0;
        std::uint32_t at = 0;
        while (left > 3 && tried < left && work_ < maxWork) {
            if (!isEar(at)) {
                at = next_[at];
                ++tried;
                continue;
            }
            emit(at, out);
            next_[previous_[at]] = next_[at];
            previous_[next_[at]] = previous_[at];
            at = next_[next_[at]];  // one further: ears all round make better triangles than a fan
            --left;
            tried = 0;
        }
        for (; left >= 3; --left) {  // the last triangle, or all where there was no ear
            const auto middle = next_[at];
            emit(middle, out);
            next_[at] = next_[middle];
            previous_[next_[middle]] = at;
        }
    }

private:
    void emit(std::uint32_t ear, std::vector<std::uint32_t>& out) const {
        out.insert(out.end(), {previous_[ear], ear, next_[ear]});
    }
    bool isEar(std::uint32_t ear) {
        const auto& a = points_[previous_[ear]];
        const auto& b = points_[ear];
        const auto& c = points_[next_[ear]];
        if (!(cross(a, b, c) > 0.0)) return false;
        for (auto i = next_[next_[ear]]; i != previous_[ear]; i = next_[i]) {
            const auto& p = points_[i];
            ++work_;
            // A corner at the same place as one of the ear's does not spoil it (holes are cut in
            // with a seam of doubled corners).
            if (p == a || p == b || p == c) continue;
            if (cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0)
                return false;
        }
        return true;
    }

    /// Corners looked at before the rest is cut as a fan. A simple polygon of the largest size
    /// needs about a quarter of it; one made to be slow would need its number of corners cubed.
    static constexpr std::uint64_t maxWork = 200'000'000;

    std::vector<math::dvec2> points_;
    std::vector<std::uint32_t> next_, previous_;
    std::uint64_t work_ = 0;
};

}  // namespace

void triangulate(std::span<const math::vec3> polygon, std::vector<std::uint32_t>& out) {
    if (polygon.size() < 3) return;
    if (polygon.size() == 3) {
        out.insert(out.end(), {0, 1, 2});
        return;
    }
    const bool finite = std::all_of(polygon.begin(), polygon.end(), [](const math::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    if (!finite) {  // dropped later, triangle by triangle
        for (std::uint32_t i = 2; i < polygon.size(); ++i) out.insert(out.end(), {0, i - 1, i});
        return;
    }
    auto flat = flattened(polygon);
    bool convex = true;
    for (std::size_t i = 0; i < flat.size() && convex; ++i)
        convex = cross(flat[i], flat[(i + 1) % flat.size()], flat[(i + 2) % flat.size()]) >= 0.0;
    if (convex && polygon.size() == 4) {  // the common case, and how everybody else cuts it
        out.insert(out.end(), {0, 1, 2, 0, 2, 3});
        return;
    }
    EarClipper{std::move(flat)}.run(out);
}

}  // namespace gnomon::importer
