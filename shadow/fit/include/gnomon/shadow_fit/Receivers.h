#pragma once

#include <gnomon/math/BoxTree.h>
#include <gnomon/math/ConvexBody.h>
#include <gnomon/math/View.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::shadow_fit {

struct LightShape;

/// Depths along a view's axis between which something is seen, metres in eye space.
struct DepthSpan {
    double near = 0.0, far = 0.0;
};
/// From the nearest of both to the farthest; nothing where neither sees anything.
inline std::optional<DepthSpan> together(const std::optional<DepthSpan>& a,
                                         const std::optional<DepthSpan>& b) {
    if (!a || !b) return a ? a : b;
    return DepthSpan{.near = std::min(a->near, b->near), .far = std::max(a->far, b->far)};
}

/// What can be seen and lit, as convex pieces that each hold a part of it: the boxes of a scene's
/// chunks, cut to the view volume and to where the light reaches. Its memory is kept.
class Receivers {
public:
    void clear() noexcept;
    /// Adds what a view sees of the boxes. Views that are not finite see nothing.
    /// @param light  what it cannot reach is left out; nullptr: all that is seen
    /// @param depth  what is nearer or farther is not seen
    void add(const math::View& view, const LightShape* light, const math::BoxTree& boxes,
             const std::optional<DepthSpan>& depth = {});

    /// Takes flat pieces off the outline, as the light sees it, that nothing stands over: they are
    /// lit, with or without a map, and a map that need not hold them has finer texels elsewhere.
    /// Pieces that are partly so are cut.
    /// @param reach  of lookups, in units of the light's plane: what is as near to a ray counts
    void dropUnshadowed(const LightShape& light, const math::BoxTree& casters, double reach = 0.0);

    /// False where nothing can shadow any of it: no map is needed.
    bool mayBeShadowed(const LightShape& light, const math::BoxTree& casters,
                       double reach = 0.0) const;

    bool empty() const noexcept { return points_.empty(); }
    /// Corners of all pieces, world space.
    std::span<const math::dvec3> points() const noexcept { return points_; }
    std::size_t pieces() const noexcept { return pieces_.size(); }
    std::span<const math::dvec3> piece(std::size_t i) const noexcept {
        return std::span{points_}.subspan(pieces_[i].first, pieces_[i].count);
    }

private:
    struct Piece {
        std::uint32_t first = 0, count = 0;  ///< in points_
        int flat = -1;                       ///< the axis in which it has no extent
    };
    void addPiece(std::span<const math::dvec3> points, int flat);
    std::span<const math::dvec3> cutFrom(const std::array<math::dvec3, 8>& corners, double size,
                                         math::Box box, int flat,
                                         std::span<const math::Plane> planes);
    /// Of points that are known to differ and to be finite.
    void addWhole(std::span<const math::dvec3> points, int flat);

    std::vector<math::dvec3> points_;
    std::vector<Piece> pieces_;
    math::ConvexBody body_;
    std::vector<math::dvec3> flat_;
};

/// The scene as the fits see it: boxes of some dozens of triangles.
struct Boxes {
    const math::BoxTree& tree;
    /// Of each box: a quarter of its triangles' area by its volume, 1 / metres: how many triangles,
    /// in the mean, a metre of a ray meets in it. None: all are solid.
    std::span<const double> density = {};
};

/// A point of what is seen.
struct Sample {
    math::dvec3 world{0.0};
    /// How likely there is an edge of a shadow, 0 to 1: what a fit's texels are for.
    double weight = 1.0;
};

/// What is seen, by rays through a grid of pixels: a coarse picture, each point for an equal share
/// of it. A box stops as many rays as triangles of its area, spread in it at random, would.
/// @param perSide  rays a side of each view's picture
/// @param depth    points nearer or farther are not seen
std::vector<Sample> samplePicture(std::span<const math::View> views, const Boxes& boxes,
                                  int perSide, const std::optional<DepthSpan>& depth = {});
/// Weighs samples by what is between them and a light: where nothing is, or much, no edge is
/// likely.
void weigh(std::span<Sample> samples, const LightShape& light, const Boxes& boxes);

}  // namespace gnomon::shadow_fit
