#pragma once

#include <gnomon/scene/Material.h>

namespace gnomon::importer {

/// A metallic-roughness surface as glTF 2.0 defines it.
struct MetallicRoughness {
    math::vec4 base{1.0F};  ///< linear, a = coverage
    double metallic = 0.0;
    double roughness = 1.0;
};

/// How much of its base colour a pure metal keeps as diffuse. A real one keeps none and shows its
/// surroundings instead; we have none to mirror, and it would be black but for its highlights.
inline constexpr double metalDiffuse = 0.3;

/// Blinn-Phong's exponent for a roughness: 2 / r^4 - 2, within 2..2048.
/// Source: Brian Karis. Specular BRDF Reference. 2013 (alpha = roughness^2, n = 2 / alpha^2 - 2).
float shininessOf(double roughness);

/// Writes diffuse, specular and shininess.
void setMetallicRoughness(scene::PhongMaterial& material, const MetallicRoughness& surface);

/// Each component within [0, most]; NaN becomes 0.
math::vec3 clamped(const math::dvec3& color, double most = 1.0);

/// The colour u8 linear that vertex colours travel as; components are clamped to 0..1.
std::uint8_t byteOf(double value);
double linearFromSrgb(double value);

}  // namespace gnomon::importer
