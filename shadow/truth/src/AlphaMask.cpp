#include "AlphaMask.h"

#include <algorithm>
#include <cmath>

namespace gnomon::truth {
namespace {

int wrapped(int at, int size, scene::Texture::Wrap wrap) {
    const auto modulo = [](int a, int n) { return ((a % n) + n) % n; };
    switch (wrap) {
        case scene::Texture::Wrap::clamp:
            return std::clamp(at, 0, size - 1);
        case scene::Texture::Wrap::mirror: {
            const int twice = modulo(at, 2 * size);
            return twice < size ? twice : 2 * size - 1 - twice;
        }
        case scene::Texture::Wrap::repeat:
            break;
    }
    return modulo(at, size);
}

}  // namespace

AlphaMask::AlphaMask(const field::Aspect& aspect, const scene::Geometry& geometry,
                     const scene::PhongMaterial& material)
    : keptCoords_{geometry.texCoords.get()},
      keptColors_{geometry.colors.get()},
      rowS_{material.texRowS.get()},
      rowT_{material.texRowT.get()},
      alpha_{material.diffuse->w},
      cutoff_{material.alphaCutoff.get()} {
    const std::size_t vertices = geometry.positions->size() / sizeof(std::array<float, 3>);
    const auto coords = keptCoords_.as<std::array<float, 2>>();
    const auto colors = keptColors_.as<Pixel>();
    if (coords.size() == vertices) texCoords_ = coords;
    if (colors.size() == vertices) colors_ = colors;
    const scene::Texture* texture = aspect.get(material.diffuseMap.get());
    if (texture == nullptr || texCoords_.empty()) return;
    keptPixels_ = texture->pixels.get();
    const auto pixels = keptPixels_.as<Pixel>();
    const glm::ivec2 size = texture->size;
    if (size.x <= 0 || size.y <= 0 ||
        pixels.size() != static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))
        return;
    pixels_ = pixels;
    size_ = size;
    wrapS_ = texture->wrapS;
    wrapT_ = texture->wrapT;
    nearest_ = texture->nearest;
}

float AlphaMask::texel(int x, int y) const {
    const auto column = static_cast<std::size_t>(wrapped(x, size_.x, wrapS_));
    const auto row = static_cast<std::size_t>(wrapped(y, size_.y, wrapT_));
    return static_cast<float>(pixels_[row * static_cast<std::size_t>(size_.x) + column][3]) /
           255.0F;
}

float AlphaMask::textureAlpha(math::vec2 at) const {
    const math::vec2 place = at * math::vec2{size_};
    // Coordinates no texture can have: what the shader reads there is as good as nothing.
    if (!(std::abs(place.x) < 1e8F && std::abs(place.y) < 1e8F)) return 1.0F;
    if (nearest_) {
        return texel(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
    }
    const math::vec2 corner = glm::floor(place - 0.5F);
    const math::vec2 share = place - 0.5F - corner;
    const auto x = static_cast<int>(corner.x);
    const auto y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), share.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), share.x), share.y);
}

bool AlphaMask::covers(const glm::uvec3& corners, float u, float v) const {
    const float w = 1.0F - u - v;
    float alpha = alpha_;
    if (!pixels_.empty()) {
        const auto between = [&](std::size_t axis) {
            return texCoords_[corners.x][axis] * w + texCoords_[corners.y][axis] * u +
                   texCoords_[corners.z][axis] * v;
        };
        const math::vec3 t{between(0), between(1), 1.0F};
        alpha *= textureAlpha({glm::dot(rowS_, t), glm::dot(rowT_, t)});
    }
    if (!colors_.empty()) {
        alpha *= (static_cast<float>(colors_[corners.x][3]) * w +
                  static_cast<float>(colors_[corners.y][3]) * u +
                  static_cast<float>(colors_[corners.z][3]) * v) /
                 255.0F;
    }
    return alpha >= cutoff_;
}

}  // namespace gnomon::truth
