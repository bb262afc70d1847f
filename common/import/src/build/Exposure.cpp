#include "build/Exposure.h"

#include <algorithm>
#include <cmath>

namespace gnomon::importer {
namespace {

double distance(const math::Box& box, const math::dvec3& point) noexcept {
    return glm::length(glm::max(glm::max(box.min - point, point - box.max), math::dvec3{0.0}));
}

/// Luminous part of a linear colour (ITU-R BT.709), so that a deep blue lamp is not taken for
/// bright.
double luminance(const math::vec3& c) noexcept {
    return 0.2126 * double{c.x} + 0.7152 * double{c.y} + 0.0722 * double{c.z};
}

}  // namespace

double exposure(std::span<const LightDraft> lights, std::span<const math::Box> drawn,
                const math::Box& bounds) {
    double sun = 0.0;
    double lamp = 0.0;
    const double radius = bounds.empty() ? 1.0 : bounds.radius();
    for (const LightDraft& light : lights) {
        const double brightness = light.intensity * luminance(light.color);
        if (light.kind == LightDraft::Kind::directional) {
            sun = std::max(sun, brightness);
            continue;
        }
        double reach = std::numeric_limits<double>::infinity();
        for (const auto& box : drawn) reach = std::min(reach, distance(box, light.positionWorld));
        if (!std::isfinite(reach)) reach = 0.0;
        reach = std::max(reach, radius / 7.0);
        if (light.range > 0.0) reach = std::min(reach, light.range / 2.0);
        // A scene of one point has no size to go by.
        if (reach > 0.0) lamp = std::max(lamp, brightness / (reach * reach));
    }
    const double brightest = sun > 0.0 ? sun : lamp;
    const double factor = 1.0 / brightest;
    return brightest > 0.0 && std::isfinite(factor) ? factor : 1.0;
}

double derivedRange(double intensity) { return std::sqrt(std::max(intensity, 0.0) / 0.01); }

}  // namespace gnomon::importer
