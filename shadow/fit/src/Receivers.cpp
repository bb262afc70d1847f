#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "LightPlane.h"

namespace gnomon::shadow_fit {
namespace {

using math::dvec3;
using math::Plane;

/// A box of so many times a view volume's size is cut out of the volume, not the volume out of it.
constexpr double hugeBox = 1e6;

/// As far as a billion times the near plane, also where there is no far plane, or none that
/// rounding has left where it was.
std::array<dvec3, 8> cornersOf(math::dmat4 clipFromWorld) {
    for (int column = 0; column < 4; ++column)
        clipFromWorld[column][2] -= 1e-9 * clipFromWorld[column][3];
    return math::frustumCorners(clipFromWorld);
}

/// Planes around what is seen and lit.
struct Volume {
    std::array<Plane, 18> planes = {};
    std::size_t count = 0;
    std::size_t sides = 0;  ///< the first so many: the view's own
    void add(const Plane& plane) {
        // A side without a normal (an infinite far plane) cuts nothing.
        if (plane.normal != dvec3{0.0}) planes[count++] = plane;
    }
    std::span<const Plane> all() const { return std::span{planes}.first(count); }
    std::span<const Plane> others() const { return all().subspan(sides); }
};

Volume volumeOf(const math::View& view, const LightShape* light,
                const std::optional<DepthSpan>& depth) {
    Volume volume;
    for (const Plane& plane : math::frustumPlanes(view.clipFromWorld())) volume.add(plane);
    volume.sides = volume.count;
    if (depth) {
        // World to eye depth: the axis is the third row, with the eye looking along -z.
        const math::dvec4 row = glm::transpose(view.eyeFromWorld)[2];
        const double scale = glm::length(dvec3{row});
        if (scale > 0.0) {
            volume.add({-dvec3{row} / scale, (-row.w - depth->near) / scale});
            volume.add({dvec3{row} / scale, (row.w + depth->far) / scale});
        }
    }
    if (light == nullptr || light->kind == LightKind::directional) return volume;
    if (light->range > 0.0) {
        for (int axis = 0; axis < 3; ++axis) {
            dvec3 normal{0.0};
            normal[axis] = 1.0;
            volume.add({normal, light->range - light->position[axis]});
            volume.add({-normal, light->range + light->position[axis]});
        }
    }
    if (light->kind == LightKind::spot) {
        const auto sides = math::frustumPlanes(coneCamera(*light, 1e-4, 1.0));
        for (std::size_t i = 0; i < 4; ++i) volume.add(sides[i]);
    }
    return volume;
}

}  // namespace

void Receivers::clear() noexcept {
    points_.clear();
    pieces_.clear();
}

void Receivers::addPiece(std::span<const dvec3> points, int flat) {
    Piece piece{.first = static_cast<std::uint32_t>(points_.size()), .flat = flat};
    for (const dvec3& p : points) {
        const auto same = [&](const dvec3& q) { return p == q; };
        if (isPlace(p) && std::none_of(points_.begin() + piece.first, points_.end(), same))
            points_.push_back(p);
    }
    piece.count = static_cast<std::uint32_t>(points_.size()) - piece.first;
    if (piece.count > 0) pieces_.push_back(piece);
}

void Receivers::addWhole(std::span<const dvec3> points, int flat) {
    pieces_.push_back({.first = static_cast<std::uint32_t>(points_.size()),
                       .count = static_cast<std::uint32_t>(points.size()),
                       .flat = flat});
    points_.insert(points_.end(), points.begin(), points.end());
}

/// What a view sees of a box so large, or without an end, that its own corners have no precision
/// left: its view volume, cut to the box.
/// @param planes  that cut it, but for the view's own
std::span<const dvec3> Receivers::cutFrom(const std::array<dvec3, 8>& corners, double size,
                                          math::Box box, int flat, std::span<const Plane> planes) {
    flat_.clear();
    const double level = flat < 0 ? 0.0 : box.min[flat];
    if (flat >= 0) {
        // Rounding must not miss what has no thickness.
        const double thickness = 1e-9 * (size + std::abs(level));
        box.min[flat] = level - thickness;
        box.max[flat] = level + thickness;
    }
    body_.assign(corners);
    for (const Plane& plane : planes) body_.clip(plane);
    body_.clip(box);
    if (flat < 0) return body_.points();
    for (dvec3 p : body_.points()) {
        p[flat] = level;
        flat_.push_back(p);
    }
    return flat_;
}

void Receivers::add(const math::View& view, const LightShape* light, const math::BoxTree& boxes,
                    const std::optional<DepthSpan>& depth) {
    if (!view.usable()) return;
    const Volume volume = volumeOf(view, light, depth);
    const auto corners = cornersOf(view.clipFromWorld());
    math::Box whole;
    for (const dvec3& corner : corners) whole.add(corner);
    const bool bounded = std::all_of(corners.begin(), corners.end(), isPlace);
    const dvec3 eye = view.eyeWorld();
    // What looks as small as this, with all that is in it, is taken as it stands.
    const auto small = [&](const math::Box& box) {
        const dvec3 nearest = glm::clamp(eye, box.min, box.max);
        return glm::length(box.size()) < 0.01 * glm::length(nearest - eye);
    };
    boxes.cover(volume.all(), small, [&](const math::Box& box, bool inside) {
        const dvec3 size = box.size();
        const int flat = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : size.z == 0.0 ? 2 : -1;
        if (inside) {
            std::array<dvec3, 8> all;
            for (int i = 0; i < 8; ++i) all[static_cast<std::size_t>(i)] = box.corner(i);
            if (flat < 0 && isPlace(box.min) && isPlace(box.max))
                addWhole(all, flat);
            else
                addPiece(all, flat);
            return;
        }
        if (bounded && !(box.radius() < hugeBox * whole.radius())) {
            addPiece(cutFrom(corners, whole.radius(), box, flat, volume.others()), flat);
            return;
        }
        body_.assign(box);
        for (const Plane& plane : volume.all()) body_.clip(plane);
        addPiece(body_.points(), flat);
    });
}

}  // namespace gnomon::shadow_fit
