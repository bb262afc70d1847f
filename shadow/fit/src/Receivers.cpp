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

/// Planes around what is seen and lit.
struct Volume {
    std::array<Plane, 18> planes = {};
    std::size_t count = 0;
    void add(const Plane& plane) {
        // A side without a normal (an infinite far plane) cuts nothing.
        if (plane.normal != dvec3{0.0}) planes[count++] = plane;
    }
    std::span<const Plane> all() const { return std::span{planes}.first(count); }
};

Volume volumeOf(const math::View& view, const LightShape* light,
                const std::optional<DepthSpan>& depth) {
    Volume volume;
    for (const Plane& plane : math::frustumPlanes(view.clipFromWorld())) volume.add(plane);
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
        if (math::isFinite(p) && std::none_of(points_.begin() + piece.first, points_.end(), same))
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

void Receivers::add(const math::View& view, const LightShape* light, const math::BoxTree& boxes,
                    const std::optional<DepthSpan>& depth) {
    if (!math::isFinite(view.clipFromWorld())) return;
    const Volume volume = volumeOf(view, light, depth);
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
            std::array<dvec3, 8> corners;
            for (int i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = box.corner(i);
            if (flat < 0 && math::isFinite(box.min) && math::isFinite(box.max))
                addWhole(corners, flat);
            else
                addPiece(corners, flat);
            return;
        }
        body_.assign(box);
        for (const Plane& plane : volume.all()) body_.clip(plane);
        addPiece(body_.points(), flat);
    });
}

}  // namespace gnomon::shadow_fit
