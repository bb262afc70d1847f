// Plants, wood, water and cloth.
#include <gnomon/demo/Random.h>
#include <gnomon/demo/Textures.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "Noise.h"
#include "Paint.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// @param reference  The size for which the surface's heights are given, in texels.
Texture finished(const char* name, std::uint32_t size, std::uint32_t reference,
                 const Surface& surface) {
    Painted p = painted(name, size, surface);
    // The same slopes at any size.
    const float scale = static_cast<float>(size) / static_cast<float>(reference);
    for (float& height : p.heights) height *= scale;
    Image normal = normalMap(std::string{name} + "-normal", size, p.heights);
    return {.colour = std::move(p.colour), .normal = std::move(normal)};
}

/// An empty cut-out picture: transparent, but of a leaf's colour, so that mipmaps and filtering
/// bring no foreign colour to the edges.
Image clearCutOut(const char* name, std::uint32_t size, const glm::vec3& colour) {
    Image image{name, size, size};
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        image.pixels[i] = toByte(colour.x);
        image.pixels[i + 1] = toByte(colour.y);
        image.pixels[i + 2] = toByte(colour.z);
        image.pixels[i + 3] = 0;
    }
    return image;
}

/// Lays @p colour over a pixel with the given coverage.
void lay(std::uint8_t* pixel, const glm::vec3& colour, float coverage) {
    if (coverage <= 0.0F) return;
    for (int c = 0; c < 3; ++c) {
        const float old = static_cast<float>(pixel[c]) / 255.0F;
        pixel[c] = toByte(old + (colour[c] - old) * coverage);
    }
    pixel[3] = std::max(pixel[3], toByte(coverage));
}

/// One leaf: from its stalk along a direction, widest a little before the middle.
struct Leaf {
    glm::vec2 base{0.0F};  ///< 0 to 1, y downwards
    float angle = 0.0F;
    float length = 0.1F;
    float width = 0.04F;  ///< half of it
    glm::vec3 colour{0.0F};
    bool veined = true;
};

void draw(Image& image, const Leaf& leaf) {
    const auto size = static_cast<float>(image.width);
    const glm::vec2 along{std::cos(leaf.angle), std::sin(leaf.angle)};
    const auto clampPixel = [&](float x) {
        return static_cast<std::uint32_t>(std::clamp(x * size, 0.0F, size - 1.0F));
    };
    const float reach = leaf.length + 0.01F;
    for (std::uint32_t y = clampPixel(leaf.base.y - reach); y <= clampPixel(leaf.base.y + reach);
         ++y) {
        for (std::uint32_t x = clampPixel(leaf.base.x - reach);
             x <= clampPixel(leaf.base.x + reach); ++x) {
            const glm::vec2 p = (glm::vec2{x, y} + 0.5F) / size - leaf.base;
            const float t = glm::dot(p, along) / leaf.length;
            if (t <= 0.0F || t >= 1.0F) continue;
            const float side = glm::dot(p, glm::vec2{-along.y, along.x});
            const float outline = leaf.width * std::pow(std::sin(pi * std::pow(t, 0.8F)), 0.8F);
            const float coverage = std::clamp((outline - std::abs(side)) * size + 0.5F, 0.0F, 1.0F);
            glm::vec3 colour = leaf.colour * (0.86F + 0.28F * t);
            if (leaf.veined) {
                const float rib = std::abs(side) * size;
                const float vein =
                    std::abs(std::fmod(t * 9.0F + std::abs(side) * 30.0F, 1.0F) - 0.5F);
                colour *= 1.0F + 0.30F * (1.0F - ramp(0.5F, 2.0F, rib)) +
                          0.12F * (1.0F - ramp(0.0F, 0.2F, vein)) + (side > 0.0F ? 0.06F : -0.06F);
            }
            lay(image.at(x, y), colour, coverage);
        }
    }
}

}  // namespace

Texture bark(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 37 + 1};
    return finished("bark", size, 512, [&](float u, float v) {
        const float warp = 0.05F * noise.fractal(u, v, 6, 4);
        const float ridges = 1.0F - 2.0F * std::abs(noise.fractal(u + warp, v, 12, 3, 4));
        const float grain = noise.fractal(u, v, 40, 20, 3);
        const glm::vec3 colour =
            glm::mix(glm::vec3{0.27F, 0.21F, 0.17F}, glm::vec3{0.58F, 0.49F, 0.40F},
                     ramp(0.2F, 1.0F, ridges + 0.2F * grain));
        return Texel{.colour = colour, .height = 7.0F * ramp(0.2F, 0.9F, ridges) + 1.5F * grain};
    });
}

Texture wood(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 37 + 2};
    return finished("wood", size, 512, [&](float u, float v) {
        const float fibre = noise.fractal(u, v, 2, 48, 3);
        const float bands = noise.fractal(u + 0.02F * fibre, v, 1, 8, 4);
        const glm::vec3 colour =
            glm::mix(glm::vec3{0.36F, 0.25F, 0.16F}, glm::vec3{0.56F, 0.42F, 0.28F},
                     std::clamp(0.5F + 0.7F * bands + 0.4F * fibre, 0.0F, 1.0F));
        return Texel{.colour = colour, .height = 1.5F * fibre + bands};
    });
}

Texture grass(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 37 + 3};
    return finished("grass", size, 512, [&](float u, float v) {
        const float cloud = noise.fractal(u, v, 4, 6);
        const float tufts = noise.fractal(u, v, 40, 4);
        glm::vec3 colour = glm::mix(glm::vec3{0.39F, 0.44F, 0.22F}, glm::vec3{0.68F, 0.61F, 0.36F},
                                    std::clamp(0.5F + 0.6F * cloud, 0.0F, 1.0F));
        colour *= 1.0F + 0.35F * tufts;
        return Texel{.colour = colour, .height = 5.0F * tufts};
    });
}

Texture water(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 37 + 4};
    return finished("water", size, 256, [&](float u, float v) {
        const float warp = 0.06F * noise.fractal(u, v, 3, 2);
        const float ripple = noise.fractal(u + warp, v - warp, 6, 3);
        return Texel{.colour = glm::vec3{0.24F, 0.45F, 0.49F} * (1.0F + 0.25F * ripple),
                     .height = 6.0F * ripple};
    });
}

Texture leaves(std::uint64_t seed, std::uint32_t size) {
    Random random{seed, 21};
    Image image = clearCutOut("leaves", size, {0.33F, 0.43F, 0.17F});
    const auto green = [&] {
        const float t = random.unit();
        return glm::mix(glm::vec3{0.27F, 0.38F, 0.14F}, glm::vec3{0.46F, 0.54F, 0.22F}, t);
    };
    // Twigs fan out from the lower middle; leaves stand on both sides and at the tip of each.
    for (int twig = 0; twig < 5; ++twig) {
        const float heading = -pi * 0.5F + (static_cast<float>(twig) - 2.0F) * 0.52F;
        const glm::vec2 along{std::cos(heading), std::sin(heading)};
        const glm::vec2 root{0.5F, 0.93F};
        const float reach = 0.62F - 0.05F * std::abs(static_cast<float>(twig) - 2.0F);
        draw(image, {.base = root,
                     .angle = heading,
                     .length = reach,
                     .width = 0.006F,
                     .colour = {0.36F, 0.28F, 0.18F},
                     .veined = false});
        for (int i = 1; i <= 5; ++i) {
            const float t = static_cast<float>(i) / 5.0F;
            for (const float side : {-1.0F, 1.0F}) {
                draw(image, {.base = root + along * (reach * t * 0.92F),
                             .angle = heading + side * random.between(0.5F, 0.95F),
                             .length = random.between(0.17F, 0.23F),
                             .width = random.between(0.036F, 0.05F),
                             .colour = green()});
            }
        }
        draw(image, {.base = root + along * (reach * 0.9F),
                     .angle = heading,
                     .length = 0.22F,
                     .width = 0.045F,
                     .colour = green()});
    }
    return {.colour = std::move(image), .normal = {}};
}

Texture needles(std::uint64_t seed, std::uint32_t size) {
    Random random{seed, 22};
    Image image = clearCutOut("needles", size, {0.17F, 0.27F, 0.15F});
    // Upright plumes side by side, dense in the middle, frayed at the top.
    for (int plume = 0; plume < 34; ++plume) {
        const float x = random.between(0.10F, 0.90F);
        const float middle = 1.0F - std::abs(x - 0.5F) * 1.4F;
        const glm::vec2 root{0.5F + (x - 0.5F) * 0.6F, 0.97F};
        const glm::vec2 tip{x, 0.97F - random.between(0.55F, 0.93F) * middle};
        const float heading = std::atan2(tip.y - root.y, tip.x - root.x);
        const float reach = glm::distance(root, tip);
        const glm::vec2 along{std::cos(heading), std::sin(heading)};
        for (int i = 2; i <= 16; ++i) {
            const float t = static_cast<float>(i) / 16.0F;
            const float tone = random.unit() * (0.6F + 0.4F * t);
            const glm::vec3 colour =
                glm::mix(glm::vec3{0.13F, 0.22F, 0.11F}, glm::vec3{0.29F, 0.40F, 0.22F}, tone);
            for (const float side : {-1.0F, 1.0F}) {
                draw(image, {.base = root + along * (reach * t * 0.9F),
                             .angle = heading + side * random.between(0.15F, 0.6F),
                             .length = random.between(0.06F, 0.11F),
                             .width = random.between(0.008F, 0.013F),
                             .colour = colour,
                             .veined = false});
            }
        }
    }
    return {.colour = std::move(image), .normal = {}};
}

Texture banner(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 37 + 5};
    Painted p = painted("banner", size, [&](float u, float v) {
        const float weave = 0.03F * (std::sin(u * 512.0F * pi) + std::sin(v * 512.0F * pi));
        const glm::vec3 gold{0.90F, 0.69F, 0.25F};
        glm::vec3 colour =
            glm::vec3{0.60F, 0.10F, 0.09F} * (1.0F + 0.2F * noise.fractal(u, v, 4, 4));
        // The cloth is three times as long as wide; the emblem sits in its upper third.
        const glm::vec2 from{u - 0.5F, (v - 0.30F) * 3.0F};
        const float distance = glm::length(from);
        const float angle = std::atan2(from.y, from.x);
        const float ray = 0.5F + 0.5F * std::cos(angle * 12.0F);
        if (distance < 0.15F || (distance > 0.18F && distance < 0.21F + 0.15F * ray)) colour = gold;
        const float border = std::min({u, 1.0F - u, (1.0F - v) * 3.0F});
        if (border > 0.05F && border < 0.09F) colour = gold;
        const float band = v - 0.62F;
        if (band > 0.0F && band < 0.25F && std::fmod(band, 0.09F) < 0.02F && border > 0.09F)
            colour = gold;
        return Texel{.colour = colour * (1.0F + weave), .height = 0.0F};
    });
    return {.colour = std::move(p.colour), .normal = {}};
}

std::span<const TextureInfo> textures() {
    static constexpr std::array all{TextureInfo{"paving", paving, 1024, 4.0F},
                                    TextureInfo{"travertine", travertine, 512, 2.0F},
                                    TextureInfo{"marble", marble, 512, 3.0F},
                                    TextureInfo{"plaster", plaster, 512, 3.0F},
                                    TextureInfo{"terracotta", terracotta, 512, 1.0F},
                                    TextureInfo{"bronze", bronze, 512, 2.0F},
                                    TextureInfo{"bark", bark, 512, 1.0F},
                                    TextureInfo{"wood", wood, 512, 1.5F},
                                    TextureInfo{"grass", grass, 512, 7.0F},
                                    TextureInfo{"roof", roof, 512, 2.4F},
                                    TextureInfo{"water", water, 256, 1.5F},
                                    TextureInfo{"leaves", leaves, 512, 0.0F},
                                    TextureInfo{"needles", needles, 512, 0.0F},
                                    TextureInfo{"banner", banner, 512, 0.0F}};
    return all;
}

}  // namespace gnomon::demo
