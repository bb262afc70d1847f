#include <gnomon/math/ConvexBody.h>

#include <algorithm>
#include <cmath>

namespace gnomon::math {
namespace {

/// Rises with the angle of a direction, from 0 to 4 in a turn.
double turn(double x, double y) {
    const double sum = std::abs(x) + std::abs(y);
    if (!(sum > 0.0) || !std::isfinite(sum)) return 0.0;
    const double share = y / sum;
    return x < 0.0 ? 2.0 - share : y < 0.0 ? 4.0 + share : share;
}

}  // namespace

/// Orders the points of the cut, a convex polygon, around its centre, seen along @p normal.
void ConvexBody::sortCut(const dvec3& normal) {
    dvec3 centre{0.0};
    for (const auto& p : cut_) centre += p;
    centre /= static_cast<double>(cut_.size());  // never called with no points
    const dvec3 helper = std::abs(normal.x) < 0.7 ? dvec3{1.0, 0.0, 0.0} : dvec3{0.0, 1.0, 0.0};
    const dvec3 u = glm::cross(normal, helper);
    const dvec3 v = glm::cross(normal, u);
    const double scale = glm::length(normal);
    turns_.clear();
    for (const auto& p : cut_)
        turns_.emplace_back(turn(glm::dot(p - centre, u) * scale, glm::dot(p - centre, v)), p);
    std::sort(turns_.begin(), turns_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::transform(turns_.begin(), turns_.end(), cut_.begin(),
                   [](const auto& at) { return at.second; });
}

void ConvexBody::addFace(std::initializer_list<dvec3> corners) {
    points_.insert(points_.end(), corners.begin(), corners.end());
    ends_.push_back(static_cast<std::uint32_t>(points_.size()));
}

void ConvexBody::assign(const std::array<dvec3, 8>& c) {
    points_.clear();
    ends_.clear();
    addFace({c[0], c[1], c[2], c[3]});
    addFace({c[4], c[5], c[6], c[7]});
    addFace({c[0], c[1], c[5], c[4]});
    addFace({c[1], c[2], c[6], c[5]});
    addFace({c[2], c[3], c[7], c[6]});
    addFace({c[3], c[0], c[4], c[7]});
}

void ConvexBody::assign(const Box& box) {
    points_.clear();
    ends_.clear();
    if (box.empty()) return;
    const auto c = [&](int i) { return box.corner(i); };
    assign(std::array{c(0), c(1), c(3), c(2), c(4), c(5), c(7), c(6)});
}

void ConvexBody::clip(const Plane& plane) {
    distances_.clear();
    bool anyOutside = false;
    bool anyInside = false;
    for (const dvec3& p : points_) {
        const double d = plane.distance(p);
        distances_.push_back(d);
        (d >= 0.0 ? anyInside : anyOutside) = true;
    }
    if (!anyOutside) return;
    keptPoints_.clear();
    keptEnds_.clear();
    cut_.clear();
    std::uint32_t first = 0;
    for (const std::uint32_t end : ends_) {
        if (!anyInside) break;
        const std::size_t start = keptPoints_.size();
        for (std::uint32_t i = first; i < end; ++i) {
            const std::uint32_t next = i + 1 < end ? i + 1 : first;
            const double da = distances_[i];
            const double db = distances_[next];
            if (da >= 0.0) keptPoints_.push_back(points_[i]);
            if ((da >= 0.0) != (db >= 0.0)) {
                // One is >= 0 and the other < 0, so da - db is not zero.
                const dvec3 p = points_[i] + (points_[next] - points_[i]) * (da / (da - db));
                keptPoints_.push_back(p);
                cut_.push_back(p);
            }
        }
        first = end;
        if (keptPoints_.size() - start >= 3)
            keptEnds_.push_back(static_cast<std::uint32_t>(keptPoints_.size()));
        else
            keptPoints_.resize(start);
    }
    if (cut_.size() >= 3) {
        sortCut(plane.normal);
        keptPoints_.insert(keptPoints_.end(), cut_.begin(), cut_.end());
        keptEnds_.push_back(static_cast<std::uint32_t>(keptPoints_.size()));
    }
    points_.swap(keptPoints_);
    ends_.swap(keptEnds_);
}

void ConvexBody::clip(const Box& box) {
    if (box.empty()) {
        points_.clear();
        ends_.clear();
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 normal{0.0};
        normal[axis] = 1.0;
        clip({.normal = normal, .offset = -box.min[axis]});
        clip({.normal = -normal, .offset = box.max[axis]});
    }
}

}  // namespace gnomon::math
