#include <gnomon/math/View.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::math {
namespace {

/// What is divided by: two sides that coincide are taken to be a little apart.
double apart(double low, double high) noexcept { return high != low ? high - low : 1e-9; }

}  // namespace

dvec3 View::eyeWorld() const noexcept { return dvec3{inverted(eyeFromWorld)[3]}; }

bool View::usable() const noexcept {
    constexpr double most = 1e30;  // squares and cubes of it are doubles still
    const auto within = [](const dmat4& matrix) {
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                if (!(std::abs(matrix[column][row]) <= most)) return false;
        return true;
    };
    const dmat4 clip = clipFromWorld();
    const dmat4 worldFromClip = inverted(clip);
    const dvec4 last = glm::transpose(eyeFromWorld)[3];
    if (last != dvec4{0.0, 0.0, 0.0, 1.0} || !within(clip) || !within(eyeFromWorld) ||
        !within(worldFromClip) || !within(inverted(eyeFromWorld)))
        return false;
    // There and back, at a depth a thousand times the near plane's.
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            const dvec4 world = worldFromClip * dvec4{x, y, 1e-3, 1.0};
            if (world.w == 0.0) return false;
            const dvec4 again = clip * dvec4{dvec3{world} / world.w, 1.0};
            if (!(again.w > 0.0) || !(std::abs(again.x - x * again.w) < 1e-3 * again.w) ||
                !(std::abs(again.y - y * again.w) < 1e-3 * again.w))
                return false;
        }
    return true;
}

dmat4 frustum(double left, double right, double bottom, double top, double near,
              double far) noexcept {
    // x and y: the rectangle at distance 1 becomes [-1, 1]. z: reversed, so that
    // z/w = near (far - d) / (d (far - near)) at distance d.
    const double width = apart(left, right);
    const double height = apart(bottom, top);
    const double depth = apart(near, far);
    dmat4 clip{0.0};
    clip[0][0] = 2.0 / width;
    clip[1][1] = 2.0 / height;
    clip[2][0] = (right + left) / width;
    clip[2][1] = (top + bottom) / height;
    clip[2][2] = near / depth;
    clip[2][3] = -1.0;
    clip[3][2] = near * far / depth;
    return clip;
}

dmat4 perspective(double fovy, double aspect, double near, double far) noexcept {
    const double top = std::tan(fovy * 0.5);
    return frustum(-top * aspect, top * aspect, -top, top, near, far);
}

dmat4 orthographic(const dvec3& min, const dvec3& max) noexcept {
    const auto extent = [](double low, double high) { return high > low ? high - low : 1e-9; };
    dmat4 clip{1.0};
    clip[0][0] = 2.0 / extent(min.x, max.x);
    clip[1][1] = 2.0 / extent(min.y, max.y);
    clip[2][2] = 1.0 / extent(min.z, max.z);
    clip[3][0] = -(max.x + min.x) / extent(min.x, max.x);
    clip[3][1] = -(max.y + min.y) / extent(min.y, max.y);
    clip[3][2] = -min.z / extent(min.z, max.z);  // z = max (nearest) -> 1, z = min -> 0
    return clip;
}

dmat4 lookAt(const dvec3& eye, const dvec3& centre, const dvec3& up) noexcept {
    const dvec3 offset = centre - eye;
    const double length = glm::length(offset);
    const dvec3 forward =
        length > 0.0 && std::isfinite(length) ? offset / length : dvec3{0.0, 0.0, -1.0};
    dvec3 side = glm::cross(forward, up);
    if (!(glm::dot(side, side) > 1e-18 * glm::dot(up, up)) || !(glm::dot(up, up) > 0.0)) {
        const dvec3 other =
            std::abs(forward.y) < 0.9 ? dvec3{0.0, 1.0, 0.0} : dvec3{0.0, 0.0, -1.0};
        side = glm::cross(forward, other);
    }
    side = glm::normalize(side);  // not zero: forward is unit, and the other up not along it
    const dvec3 above = glm::cross(side, forward);
    dmat4 view{1.0};
    for (int i = 0; i < 3; ++i) {
        view[i][0] = side[i];
        view[i][1] = above[i];
        view[i][2] = -forward[i];
    }
    view[3] = dvec4{-glm::dot(side, eye), -glm::dot(above, eye), glm::dot(forward, eye), 1.0};
    return view;
}

dmat4 tileFromWhole(const Rect& tile) noexcept {
    dmat4 clip{1.0};
    clip[0][0] = 1.0 / tile.width;
    clip[1][1] = 1.0 / tile.height;
    clip[3][0] = (1.0 - 2.0 * tile.left - tile.width) / tile.width;
    clip[3][1] = (1.0 - 2.0 * tile.bottom - tile.height) / tile.height;
    return clip;
}

View widened(const View& view, const dvec2& share) noexcept {
    return {.clipFromEye = tileFromWhole({.left = -share.x,
                                          .bottom = -share.y,
                                          .width = 1.0 + 2.0 * share.x,
                                          .height = 1.0 + 2.0 * share.y}) *
                           view.clipFromEye,
            .eyeFromWorld = view.eyeFromWorld};
}

View offAxis(const dvec3& eye, const ScreenCorners& screen, double near, double far) noexcept {
    const dvec3 across = screen.lowerRight - screen.lowerLeft;
    const dvec3 upward = screen.upperLeft - screen.lowerLeft;
    const double width = glm::length(across);
    const double height = glm::length(upward);
    // A screen without area, which only an application can make, has the axes of any other.
    const dvec3 right = width > 0.0 ? across / width : dvec3{1.0, 0.0, 0.0};
    const dvec3 up = height > 0.0 ? upward / height : dvec3{0.0, 1.0, 0.0};
    const dvec3 normal = glm::cross(right, up);  // toward the viewer
    const dvec3 toEye = eye - screen.lowerLeft;
    const double distance = std::max({glm::dot(toEye, normal), 1e-3 * width, 1e-9});
    const double x = glm::dot(toEye, right);
    const double y = glm::dot(toEye, up);

    View view;
    view.clipFromEye = frustum(-x / distance, (width - x) / distance, -y / distance,
                               (height - y) / distance, near, far);
    dmat4 eyeFromWorld{1.0};
    for (int i = 0; i < 3; ++i) {
        eyeFromWorld[i][0] = right[i];
        eyeFromWorld[i][1] = up[i];
        eyeFromWorld[i][2] = normal[i];
    }
    const dvec3 origin = screen.lowerLeft + right * x + up * y + normal * distance;
    eyeFromWorld[3] =
        dvec4{-glm::dot(right, origin), -glm::dot(up, origin), -glm::dot(normal, origin), 1.0};
    view.eyeFromWorld = eyeFromWorld;
    return view;
}

std::array<dvec3, 8> frustumCorners(const dmat4& clipFromWorld) noexcept {
    const dmat4 worldFromClip = inverted(clipFromWorld);
    std::array<dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t side = i % 4;
        const dvec4 clip{side == 1 || side == 2 ? 1.0 : -1.0, side >= 2 ? 1.0 : -1.0,
                         i < 4 ? 1.0 : 0.0, 1.0};
        const dvec4 world = worldFromClip * clip;
        corners[i] = world.w != 0.0 ? dvec3{world} / world.w
                                    : dvec3{std::numeric_limits<double>::quiet_NaN()};
    }
    return corners;
}

std::array<Plane, 6> frustumPlanes(const dmat4& clipFromWorld) noexcept {
    const dmat4 rows = glm::transpose(clipFromWorld);
    const std::array<dvec4, 6> sides{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                     rows[3] - rows[1], rows[3] - rows[2], rows[2]};
    std::array<Plane, 6> planes;
    for (std::size_t i = 0; i < 6; ++i) {
        const dvec3 normal{sides[i]};
        const double length = glm::length(normal);
        // An infinite far plane has no normal: everything is inside it.
        planes[i] =
            length > 0.0 ? Plane{normal / length, sides[i].w / length} : Plane{dvec3{0.0}, 0.0};
    }
    return planes;
}

bool mayIntersect(std::span<const Plane> planes, const Box& box) noexcept {
    if (box.empty()) return false;
    for (const Plane& plane : planes) {
        const dvec3 furthest{plane.normal.x > 0.0 ? box.max.x : box.min.x,
                             plane.normal.y > 0.0 ? box.max.y : box.min.y,
                             plane.normal.z > 0.0 ? box.max.z : box.min.z};
        if (plane.distance(furthest) < 0.0) return false;
    }
    return true;
}

}  // namespace gnomon::math
