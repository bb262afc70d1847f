#include "build/Phong.h"

#include <algorithm>
#include <cmath>

namespace gnomon::importer {
namespace {

double within(double value, double low, double high) {
    return value >= low ? std::min(value, high) : low;  // NaN: low
}

}  // namespace

float shininessOf(double roughness) {
    const double r = within(roughness, 0.01, 1.0);
    return static_cast<float>(std::clamp(2.0 / (r * r * r * r) - 2.0, 2.0, 2048.0));
}

math::vec3 clamped(const math::dvec3& color, double most) {
    return math::vec3{static_cast<float>(within(color.x, 0.0, most)),
                      static_cast<float>(within(color.y, 0.0, most)),
                      static_cast<float>(within(color.z, 0.0, most))};
}

void setMetallicRoughness(scene::PhongMaterial& material, const MetallicRoughness& surface) {
    const auto metallic = static_cast<float>(within(surface.metallic, 0.0, 1.0));
    const math::vec3 base = clamped(math::dvec3{surface.base.x, surface.base.y, surface.base.z});
    const float kept = 1.0F - metallic * static_cast<float>(1.0 - metalDiffuse);
    const auto alpha = static_cast<float>(within(double{surface.base.w}, 0.0, 1.0));
    material.diffuse = math::vec4{base * kept, alpha};
    material.specular = glm::mix(math::vec3{0.04F}, base, metallic);
    material.shininess = shininessOf(surface.roughness);
}

std::uint8_t byteOf(double value) {
    return static_cast<std::uint8_t>(std::lround(within(value, 0.0, 1.0) * 255.0));
}

double linearFromSrgb(double value) {
    const double v = within(value, 0.0, 1.0);
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace gnomon::importer
