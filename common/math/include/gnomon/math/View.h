#pragma once

#include <gnomon/math/Types.h>

#include <array>
#include <span>

namespace gnomon::math {

/// A rectangle, by shares of what it is a part of: x to the right, y up.
struct Rect {
    double left = 0.0;
    double bottom = 0.0;
    double width = 1.0;
    double height = 1.0;
    friend bool operator==(const Rect&, const Rect&) = default;
};

/// What one eye sees. Eye space: right-handed, looking along -z. Clip space: depth reversed, z/w is
/// 1 at the near plane and 0 at the far plane.
struct View {
    dmat4 clipFromEye{1.0};
    dmat4 eyeFromWorld{1.0};

    dmat4 clipFromWorld() const noexcept { return clipFromEye * eyeFromWorld; }
    /// The eye's position; of a parallel projection, the origin of its eye space.
    dvec3 eyeWorld() const noexcept;
    /// Eye space is an affine map of the world; it can be looked back through to a thousandth of
    /// the picture, and no number either way is beyond 1e30: what a view must be to see anything.
    bool usable() const noexcept;
};

/// Symmetric frustum. @p fovy vertical, radians. 0 < near < far, metres.
dmat4 perspective(double fovy, double aspect, double near, double far) noexcept;
/// Frustum through a rectangle at distance 1 in front of the eye. Sides that coincide are taken to
/// be a billionth apart.
dmat4 frustum(double left, double right, double bottom, double top, double near,
              double far) noexcept;
/// Parallel projection of the box [min, max] in eye space (z negative in front). A box without
/// extent in an axis is widened.
dmat4 orthographic(const dvec3& min, const dvec3& max) noexcept;
/// eyeFromWorld. Where up is parallel to the view direction another up is chosen.
dmat4 lookAt(const dvec3& eye, const dvec3& centre, const dvec3& up) noexcept;

/// What the tile camera decorator does: clip space of the part @p tile of a whole picture, from
/// clip space of the whole. Exact in the projection matrix: one scale and one offset an axis.
/// @pre the tile has area
/// Source: OpenSG's TileCameraDecorator.
dmat4 tileFromWhole(const Rect& tile) noexcept;

/// A view that sees more on each side, by shares of its width and height.
View widened(const View& view, const dvec2& share) noexcept;

/// A flat screen by three corners of its lit area, in metres.
struct ScreenCorners {
    dvec3 lowerLeft{-1.0, -1.0, 0.0};
    dvec3 lowerRight{1.0, -1.0, 0.0};
    dvec3 upperLeft{-1.0, 1.0, 0.0};
};

/// Off-axis view through a screen. The eye's space keeps the screen's axes, so it does not turn
/// with the head. @p near and @p far are distances along the screen's normal. An eye in or behind
/// the screen's plane is treated as one a thousandth of the screen's width in front of it.
/// Source: Robert Kooima. Generalized Perspective Projection. 2009.
View offAxis(const dvec3& eye, const ScreenCorners& screen, double near, double far) noexcept;

/// Corners of the view volume in world space: near then far, each lower left, lower right, upper
/// right, upper left. One that is infinitely far away, or of no volume at all, is not a number.
std::array<dvec3, 8> frustumCorners(const dmat4& clipFromWorld) noexcept;
/// Inner sides of the view volume: left, right, bottom, top, near, far.
std::array<Plane, 6> frustumPlanes(const dmat4& clipFromWorld) noexcept;
/// False only where the box is certainly outside one of the planes. An empty box is outside.
bool mayIntersect(std::span<const Plane> planes, const Box& box) noexcept;

}  // namespace gnomon::math
