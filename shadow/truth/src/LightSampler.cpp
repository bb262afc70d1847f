#include <gnomon/truth/LightSampler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace gnomon::truth {
namespace {

using math::dvec2;
using math::dvec3;
using shadow_fit::LightKind;

/// The unit disk from the unit square, areas kept.
/// Source: Peter Shirley, Kenneth Chiu. A Low Distortion Map Between Disk and Square. 1997.
dvec2 disk(const dvec2& u) {
    const dvec2 a = u * 2.0 - 1.0;
    if (a.x == 0.0 && a.y == 0.0) return dvec2{0.0};
    const bool wide = std::abs(a.x) > std::abs(a.y);
    const double radius = wide ? a.x : a.y;
    const double angle = wide ? std::numbers::pi / 4.0 * (a.y / a.x)
                              : std::numbers::pi / 2.0 - std::numbers::pi / 4.0 * (a.x / a.y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// A direction within a cone around an axis, uniform by solid angle.
dvec3 inCone(const dvec3& axis, const dvec3& u, const dvec3& v, double cosine, const dvec2& d) {
    // Areas of the unit disk are shares of the cone's solid angle.
    const double share = std::min(glm::dot(d, d), 1.0);
    const double c = 1.0 - share * (1.0 - cosine);
    const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
    const double length = std::sqrt(share);
    if (length == 0.0) return axis;
    return axis * c + (u * d.x + v * d.y) * (s / length);
}

LightSampler::Ray between(const dvec3& from, const dvec3& target) {
    const dvec3 way = target - from;
    const double reach = glm::length(way);
    // A point in the light itself is lit: any direction, no way.
    if (!(reach > 0.0)) return {.direction = {0.0, 1.0, 0.0}, .reach = 0.0};
    return {.direction = way / reach, .reach = reach};
}

std::uint32_t hashed(std::uint32_t x) noexcept {
    // Source: Chris Wellons. Hash Prospector, "lowbias32". 2018.
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    return x ^ (x >> 16U);
}

}  // namespace

LightSampler::LightSampler(const shadow_fit::LightShape& light, const dvec3& origin)
    : light_{light}, position_{light.position - origin} {
    std::tie(u_, v_) = shadow_fit::perpendicular(-light.direction);
    cosineOfExtent_ = std::cos(light.extent);
    if (light.kind == LightKind::spot) cosineOfCone_ = std::cos(light.halfAngle);
}

LightSampler::Ray LightSampler::centre(const dvec3& from) const {
    if (light_.kind == LightKind::directional)
        return {.direction = -light_.direction, .reach = std::numeric_limits<double>::infinity()};
    return between(from, position_);
}

LightSampler::Ray LightSampler::sample(const dvec3& from, dvec2 at) const {
    return toward(from, disk(at));
}

LightSampler::Ray LightSampler::toward(const dvec3& from, dvec2 at) const {
    switch (light_.kind) {
        case LightKind::directional:
            return {.direction = inCone(-light_.direction, u_, v_, cosineOfExtent_, at),
                    .reach = std::numeric_limits<double>::infinity()};
        case LightKind::spot: {
            const dvec2 d = at * light_.extent;
            return between(from, position_ + u_ * d.x + v_ * d.y);
        }
        case LightKind::point:
            break;
    }
    const Ray middle = between(from, position_);
    if (middle.reach <= light_.extent) return middle;  // inside the light
    const double sine = light_.extent / middle.reach;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const auto [u, v] = shadow_fit::perpendicular(middle.direction);
    const dvec3 direction = inCone(middle.direction, u, v, cosine, at);
    // To the sphere's near side: what is inside the light does not shadow.
    const double along = glm::dot(position_ - from, direction);
    const double square =
        light_.extent * light_.extent - (middle.reach * middle.reach - along * along);
    return {.direction = direction, .reach = along - std::sqrt(std::max(square, 0.0))};
}

bool LightSampler::shinesAt(const dvec3& position) const {
    if (light_.kind == LightKind::directional) return true;
    const dvec3 way = position - position_;
    const double distance = glm::length(way);
    if (light_.range > 0.0 && distance >= light_.range) return false;
    return light_.kind != LightKind::spot ||
           glm::dot(way, light_.direction) >= cosineOfCone_ * distance;
}

dvec2 stratified(std::uint32_t i, std::uint32_t pixel) noexcept {
    std::uint32_t x = 0;  // van der Corput
    std::uint32_t y = 0;  // Sobol's second dimension
    std::uint32_t direction = 1U << 31U;
    for (std::uint32_t bits = i, bit = 1U << 31U; bits != 0;
         bits >>= 1U, bit >>= 1U, direction ^= direction >> 1U) {
        if ((bits & 1U) == 0) continue;
        x ^= bit;
        y ^= direction;
    }
    const std::uint32_t scramble = hashed(pixel);
    x ^= scramble;
    y ^= hashed(scramble ^ 0x9e3779b9U);
    return {static_cast<double>(x) * 0x1p-32, static_cast<double>(y) * 0x1p-32};
}

dvec2 sunflower(std::uint32_t i, std::uint32_t n) noexcept {
    const double goldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt((i + 0.5) / n);
    return {radius * std::cos(i * goldenAngle), radius * std::sin(i * goldenAngle)};
}

}  // namespace gnomon::truth
