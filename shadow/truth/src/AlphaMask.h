#pragma once

#include <gnomon/scene/FlatScene.h>

#include <array>

namespace gnomon::truth {

/// The alpha test of a masked material on a geometry, as the shaders do it without mipmaps.
class AlphaMask {
public:
    AlphaMask(const field::Aspect& aspect, const scene::Geometry& geometry,
              const scene::PhongMaterial& material);
    /// @param corners  vertices of the triangle  @param u, v  weights of the second and third
    bool covers(const glm::uvec3& corners, float u, float v) const;

private:
    using Pixel = std::array<std::uint8_t, 4>;
    float texel(int x, int y) const;
    float textureAlpha(math::vec2 at) const;

    std::span<const std::array<float, 2>> texCoords_ = {};
    std::span<const Pixel> colors_ = {};
    std::span<const Pixel> pixels_ = {};
    field::Payload keptCoords_, keptColors_, keptPixels_;  // whatever happens to the containers
    glm::ivec2 size_{0};
    scene::Texture::Wrap wrapS_ = scene::Texture::Wrap::repeat;
    scene::Texture::Wrap wrapT_ = scene::Texture::Wrap::repeat;
    bool nearest_ = false;
    math::vec3 rowS_{1.0F, 0.0F, 0.0F};
    math::vec3 rowT_{0.0F, 1.0F, 0.0F};
    float alpha_ = 1.0F;
    float cutoff_ = 0.5F;
};

}  // namespace gnomon::truth
