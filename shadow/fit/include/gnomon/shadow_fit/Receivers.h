#pragma once

#include <gnomon/math/BoxTree.h>
#include <gnomon/math/ConvexBody.h>
#include <gnomon/math/View.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::shadow_fit {

struct LightShape;

/// What can be seen and lit, as convex pieces that each hold a part of it: the boxes of a scene's
/// chunks, cut to the view volume and to where the light reaches. Its memory is kept.
class Receivers {
public:
    void clear() noexcept;
    /// Adds what a view sees of the boxes. Views that are not finite see nothing.
    /// @param light  what it cannot reach is left out; nullptr: all that is seen
    void add(const math::View& view, const LightShape* light, const math::BoxTree& boxes);

    bool empty() const noexcept { return points_.empty(); }
    /// Corners of all pieces, world space; some more than once.
    std::span<const math::dvec3> points() const noexcept { return points_; }
    std::size_t pieces() const noexcept { return ends_.size(); }
    std::span<const math::dvec3> piece(std::size_t i) const noexcept {
        const std::size_t first = i == 0 ? 0 : ends_[i - 1];
        return std::span{points_}.subspan(first, ends_[i] - first);
    }

private:
    std::vector<math::dvec3> points_;
    std::vector<std::uint32_t> ends_;
    math::ConvexBody body_;
};

/// Where rays through a grid of pixels first meet a box: a coarse picture of what is seen, each
/// point for an equal share of it. Boxes around the eye are looked through.
/// @param perSide  rays a side of each view's picture
std::vector<math::dvec3> samplePicture(std::span<const math::View> views,
                                       const math::BoxTree& boxes, int perSide);

}  // namespace gnomon::shadow_fit
