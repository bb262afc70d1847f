#include <gnomon/client/Look.h>

#include <algorithm>
#include <cmath>

namespace gnomon::client {
namespace {

/// From the box's centre to the eye: a little to the right, as far above as a person on a step.
const math::dvec3 towardEye = glm::normalize(math::dvec3{0.45, 0.42, 0.80});
constexpr double margin = 1.05;  // of air around the box

math::Box orUnit(const math::Box& bounds) noexcept {
    if (!bounds.empty() && bounds.radius() > 0.0) return bounds;
    const math::dvec3 at = bounds.empty() ? math::dvec3{0.0} : bounds.min;
    return {.min = at - 0.5, .max = at + 0.5};
}

}  // namespace

Opening opening(double fovy, double aspect) noexcept {
    const double top = std::tan(fovy * 0.5);
    return {.left = -top * aspect, .right = top * aspect, .bottom = -top, .top = top};
}

Look lookAtBox(const math::Box& bounds, const Opening& through) noexcept {
    const math::Box box = orUnit(bounds);
    const math::dvec3 up{0.0, 1.0, 0.0};
    const math::dmat3 axes{math::lookAt(towardEye, math::dvec3{0.0}, up)};  // eyeFromWorld
    const double midX = (through.left + through.right) * 0.5;
    const double midY = (through.bottom + through.top) * 0.5;
    const double halfX = (through.right - through.left) * 0.5;  // above 0: screens have area
    const double halfY = (through.top - through.bottom) * 0.5;

    // The eye is at centre + d * back - d * (midX * right + midY * above), so that the centre is
    // seen in the middle of the opening. A corner at (x, y, z) from the centre in eye axes is then
    // inside where |x + midX z| + halfX z <= halfX d, and so for y.
    double distance = 0.0;
    for (int i = 0; i < 8; ++i) {
        const math::dvec3 corner = axes * (box.corner(i) - box.centre()) * margin;
        distance = std::max({distance, std::abs(corner.x + midX * corner.z) / halfX + corner.z,
                             std::abs(corner.y + midY * corner.z) / halfY + corner.z});
    }
    const math::dmat3 worldAxes = glm::transpose(axes);
    Look look;
    look.eye = box.centre() + worldAxes * math::dvec3{-midX, -midY, 1.0} * distance;
    look.center = look.eye - worldAxes[2] * distance;
    look.up = up;
    return look;
}

math::dmat4 worldFromEye(const Look& look) noexcept {
    return glm::inverse(math::lookAt(look.eye, look.center, look.up));
}

DepthRange depthRange(const math::Box& bounds, const math::dvec3& eye) noexcept {
    if (bounds.empty()) return {};
    double farthest = 0.0;
    for (int i = 0; i < 8; ++i) farthest = std::max(farthest, glm::length(bounds.corner(i) - eye));
    const double nearest = glm::length(eye - glm::clamp(eye, bounds.min, bounds.max));
    DepthRange range;
    // A box that is a point at the eye still gets a range.
    range.far = std::max(farthest * 1.25, 1e-3);
    range.near = std::max(nearest * 0.5, range.far / 2000.0);
    return range;
}

}  // namespace gnomon::client
