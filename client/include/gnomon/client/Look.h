#pragma once

#include <gnomon/math/View.h>

namespace gnomon::client {

/// Where someone stands in the world and where they look.
struct Look {
    math::dvec3 eye{0.0, 0.0, 5.0};
    math::dvec3 center{0.0};
    math::dvec3 up{0.0, 1.0, 0.0};
    double scale =
        1.0;  ///< metres of the world to a metre of the room; of no meaning without a room
    friend bool operator==(const Look&, const Look&) = default;
};

/// What is seen from the eye: tangents of the angles from straight ahead to the picture's edges.
struct Opening {
    double left = -0.5;
    double right = 0.5;
    double bottom = -0.5;
    double top = 0.5;
    friend bool operator==(const Opening&, const Opening&) = default;
};

/// Of a symmetric frustum. @p fovy vertical, radians.
Opening opening(double fovy, double aspect) noexcept;

/// Looks from above, from the right, straight at the box, from where it just fills the opening.
/// The scale stays 1. An empty box is treated as a unit cube.
Look lookAtBox(const math::Box& bounds, const Opening& through) noexcept;

/// The rigid map worldFromEye (right-handed, looking along -z).
math::dmat4 worldFromEye(const Look& look) noexcept;

struct DepthRange {
    double near = 0.1;  ///< metres
    double far = 1000.0;
    friend bool operator==(const DepthRange&, const DepthRange&) = default;
};

/// Encloses the box seen from @p eye in any direction, with room for things that move. Near is half
/// the distance to the box, because it is measured along a screen's normal and the box may be seen
/// at up to 60 degrees from it; inside the box 1/2000 of far. An empty box: the default range.
DepthRange depthRange(const math::Box& bounds, const math::dvec3& eye) noexcept;

}  // namespace gnomon::client
