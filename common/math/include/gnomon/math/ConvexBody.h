#pragma once

#include <gnomon/math/Types.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon::math {

/// A convex polyhedron by its faces, each a planar polygon. Clipping keeps it closed.
class ConvexBody {
public:
    ConvexBody() = default;
    /// From eight corners in the order of frustumCorners.
    explicit ConvexBody(const std::array<dvec3, 8>& corners);
    explicit ConvexBody(const Box& box);

    bool empty() const noexcept { return faces_.empty(); }
    /// Keeps what is inside the plane. Sutherland and Hodgman's clip of each face; the cut is
    /// closed with the polygon of the new edges' end points.
    void clip(const Plane& plane);
    void clip(const Box& box);
    /// Every corner, once per face it belongs to.
    std::vector<dvec3> points() const;

private:
    std::vector<std::vector<dvec3>> faces_;
};

}  // namespace gnomon::math
