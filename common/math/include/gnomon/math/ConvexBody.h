#pragma once

#include <gnomon/math/Types.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::math {

/// A convex polyhedron by its faces, each a planar polygon. Clipping keeps it closed. Its memory is
/// kept when it is assigned anew, so that one body serves many clips.
class ConvexBody {
public:
    ConvexBody() = default;
    explicit ConvexBody(const std::array<dvec3, 8>& corners) { assign(corners); }
    explicit ConvexBody(const Box& box) { assign(box); }

    /// Eight corners in the order of frustumCorners.
    void assign(const std::array<dvec3, 8>& corners);
    void assign(const Box& box);

    bool empty() const noexcept { return ends_.empty(); }
    /// Keeps what is inside the plane. Sutherland and Hodgman's clip of each face; the cut is
    /// closed with the polygon of the new edges' end points.
    void clip(const Plane& plane);
    void clip(const Box& box);
    /// Every corner, once per face it belongs to.
    std::span<const dvec3> points() const noexcept { return points_; }

private:
    void addFace(std::initializer_list<dvec3> corners);
    void sortCut(const dvec3& normal);

    std::vector<dvec3> points_;        // faces one after the other
    std::vector<std::uint32_t> ends_;  // of each face in points_
    std::vector<dvec3> keptPoints_, cut_;
    std::vector<std::uint32_t> keptEnds_;
    std::vector<double> distances_;
    std::vector<std::pair<double, dvec3>> turns_;
};

}  // namespace gnomon::math
