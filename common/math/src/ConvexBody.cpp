#include <gnomon/math/ConvexBody.h>

#include <algorithm>
#include <cmath>

namespace gnomon::math {
namespace {

/// Orders the points of a convex polygon around its centre, seen along @p normal.
void sortAround(std::vector<dvec3>& points, const dvec3& normal) {
    dvec3 centre{0.0};
    for (const auto& p : points) centre += p;
    centre /= static_cast<double>(points.size());  // never called with no points
    const dvec3 helper = std::abs(normal.x) < 0.7 ? dvec3{1.0, 0.0, 0.0} : dvec3{0.0, 1.0, 0.0};
    const dvec3 u = glm::normalize(glm::cross(normal, helper));
    const dvec3 v = glm::cross(normal, u);
    const auto angle = [&](const dvec3& p) {
        return std::atan2(glm::dot(p - centre, v), glm::dot(p - centre, u));
    };
    std::sort(points.begin(), points.end(),
              [&](const dvec3& a, const dvec3& b) { return angle(a) < angle(b); });
}

}  // namespace

ConvexBody::ConvexBody(const std::array<dvec3, 8>& c)
    : faces_{{c[0], c[1], c[2], c[3]}, {c[4], c[5], c[6], c[7]}, {c[0], c[1], c[5], c[4]},
             {c[1], c[2], c[6], c[5]}, {c[2], c[3], c[7], c[6]}, {c[3], c[0], c[4], c[7]}} {}

ConvexBody::ConvexBody(const Box& box) {
    if (box.empty()) return;
    const auto c = [&](int i) { return box.corner(i); };
    *this = ConvexBody{std::array{c(0), c(1), c(3), c(2), c(4), c(5), c(7), c(6)}};
}

void ConvexBody::clip(const Plane& plane) {
    std::vector<std::vector<dvec3>> kept;
    std::vector<dvec3> cut;
    for (const auto& face : faces_) {
        std::vector<dvec3> inside;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const dvec3& a = face[i];
            const dvec3& b = face[(i + 1) % face.size()];
            const double da = plane.distance(a);
            const double db = plane.distance(b);
            if (da >= 0.0) inside.push_back(a);
            if ((da >= 0.0) != (db >= 0.0)) {
                // One is >= 0 and the other < 0, so da - db is not zero.
                const dvec3 p = a + (b - a) * (da / (da - db));
                inside.push_back(p);
                cut.push_back(p);
            }
        }
        if (inside.size() >= 3) kept.push_back(std::move(inside));
    }
    if (cut.size() >= 3) {
        sortAround(cut, plane.normal);
        kept.push_back(std::move(cut));
    }
    faces_ = std::move(kept);
}

void ConvexBody::clip(const Box& box) {
    if (box.empty()) {
        faces_.clear();
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 normal{0.0};
        normal[axis] = 1.0;
        clip({.normal = normal, .offset = -box.min[axis]});
        clip({.normal = -normal, .offset = box.max[axis]});
    }
}

std::vector<dvec3> ConvexBody::points() const {
    std::vector<dvec3> all;
    for (const auto& face : faces_) all.insert(all.end(), face.begin(), face.end());
    return all;
}

}  // namespace gnomon::math
