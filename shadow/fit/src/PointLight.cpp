#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>
#include <cmath>

namespace gnomon::shadow_fit {

using math::dvec3;

LightShape spotThatSees(const LightShape& point, std::span<const dvec3> seen) {
    constexpr int steps = 32;
    LightShape spot = point;
    spot.kind = LightKind::spot;
    const auto towards = [&](const dvec3& p) {
        const dvec3 way = p - point.position;
        const double length = glm::length(way);
        return length > 0.0 && std::isfinite(length) ? way / length : dvec3{0.0};
    };
    dvec3 axis{0.0};
    for (const dvec3& p : seen) axis += towards(p);
    // Toward the middle of the least ball around the directions, as points of the unit sphere.
    // Source: M. Badoiu, K. Clarkson. Smaller Core-Sets for Balls. 2003.
    if (glm::length(axis) > 0.0) axis /= static_cast<double>(seen.size());
    for (int i = 0; i < steps; ++i) {
        const auto farthest =
            std::max_element(seen.begin(), seen.end(), [&](const dvec3& a, const dvec3& b) {
                const dvec3 toA = towards(a) - axis;
                const dvec3 toB = towards(b) - axis;
                return glm::dot(toA, toA) < glm::dot(toB, toB);
            });
        if (farthest == seen.end()) break;
        axis += (towards(*farthest) - axis) / (i + 2.0);
    }
    const double length = glm::length(axis);
    spot.direction = length > 1e-6 ? axis / length : dvec3{0.0, -1.0, 0.0};
    double least = 1.0;
    for (const dvec3& p : seen) {
        const dvec3 way = towards(p);
        if (way != dvec3{0.0}) least = std::min(least, glm::dot(way, spot.direction));
    }
    spot.halfAngle =
        std::clamp(std::acos(std::clamp(least, -1.0, 1.0)) * 1.01, 0.05, widestOfPoint);
    return spot;
}

}  // namespace gnomon::shadow_fit
