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

bool isFinite(const dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Planes around what is seen and lit.
struct Volume {
    std::array<Plane, 16> planes = {};
    std::size_t count = 0;
    void add(const Plane& plane) {
        // A side without a normal (an infinite far plane) cuts nothing.
        if (plane.normal != dvec3{0.0}) planes[count++] = plane;
    }
    std::span<const Plane> all() const { return std::span{planes}.first(count); }
};

Volume volumeOf(const math::View& view, const LightShape* light) {
    Volume volume;
    for (const Plane& plane : math::frustumPlanes(view.clipFromWorld())) volume.add(plane);
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

/// Where a ray enters a box, in lengths of its direction; infinite where it does not, or begins
/// inside.
double entry(const math::Box& box, const dvec3& from, const dvec3& direction) {
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (from[axis] < box.min[axis] || from[axis] > box.max[axis])
                return std::numeric_limits<double>::infinity();
            continue;
        }
        const double a = (box.min[axis] - from[axis]) / direction[axis];
        const double b = (box.max[axis] - from[axis]) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last && first > 0.0 ? first : std::numeric_limits<double>::infinity();
}

}  // namespace

void Receivers::clear() noexcept {
    points_.clear();
    ends_.clear();
}

void Receivers::add(const math::View& view, const LightShape* light, const math::BoxTree& boxes) {
    if (!math::isFinite(view.clipFromWorld())) return;
    const Volume volume = volumeOf(view, light);
    const dvec3 eye = view.eyeWorld();
    // What looks as small as this, with all that is in it, is taken as it stands.
    const auto small = [&](const math::Box& box) {
        const dvec3 nearest = glm::clamp(eye, box.min, box.max);
        return glm::length(box.size()) < 0.01 * glm::length(nearest - eye);
    };
    boxes.cover(volume.all(), small, [&](const math::Box& box, bool inside) {
        const std::size_t before = points_.size();
        if (inside) {
            for (int i = 0; i < 8; ++i) points_.push_back(box.corner(i));
        } else {
            body_.assign(box);
            for (const Plane& plane : volume.all()) body_.clip(plane);
            for (const dvec3& p : body_.points())
                if (isFinite(p)) points_.push_back(p);
        }
        if (points_.size() > before) ends_.push_back(static_cast<std::uint32_t>(points_.size()));
    });
}

std::vector<dvec3> samplePicture(std::span<const math::View> views, const math::BoxTree& boxes,
                                 int perSide) {
    std::vector<dvec3> samples;
    for (const math::View& view : views) {
        if (!math::isFinite(view.clipFromWorld())) continue;
        const math::dmat4 worldFromClip = glm::inverse(view.clipFromWorld());
        const auto unproject = [&](double x, double y, double z) {
            const math::dvec4 p = worldFromClip * math::dvec4{x, y, z, 1.0};
            return dvec3{p} / p.w;
        };
        for (int row = 0; row < perSide; ++row) {
            for (int column = 0; column < perSide; ++column) {
                const double x = (column + 0.5) / perSide * 2.0 - 1.0;
                const double y = (row + 0.5) / perSide * 2.0 - 1.0;
                const dvec3 from = unproject(x, y, 1.0);
                const dvec3 direction = unproject(x, y, 0.0) - from;
                const double t = boxes.firstAlong(from, direction, [&](const math::Box& box) {
                    return entry(box, from, direction);
                });
                const dvec3 at = from + direction * t;
                if (t <= 1.0 && isFinite(at)) samples.push_back(at);
            }
        }
    }
    return samples;
}

}  // namespace gnomon::shadow_fit
