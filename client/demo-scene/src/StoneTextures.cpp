// Stone, plaster, clay and metal.
#include <gnomon/demo/Random.h>
#include <gnomon/demo/Textures.h>

#include <glm/geometric.hpp>

#include "Noise.h"
#include "Paint.h"

namespace gnomon::demo {
namespace {

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

/// Courses of slabs; the joints of a course are where its slabs begin, sorted, in [0, 1).
using Courses = std::vector<std::vector<float>>;

Courses laidCourses(std::uint64_t seed, int count, float shortest, float longest) {
    Random random{seed, 11};
    Courses courses;
    for (int i = 0; i < count; ++i) {
        const float offset = random.unit();
        std::vector<float> lengths;
        float sum = 0.0F;
        while (sum < 1.0F) {
            lengths.push_back(random.between(shortest, longest));
            sum += lengths.back();
        }
        std::vector<float> joints;
        float at = offset;
        for (const float length : lengths) {
            joints.push_back(at - std::floor(at));
            at += length / sum;  // squeezed, so that the course closes
        }
        std::sort(joints.begin(), joints.end());
        courses.push_back(std::move(joints));
    }
    return courses;
}

}  // namespace

Texture paving(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 1};
    const int courseCount = 8;
    const Courses courses = laidCourses(seed, courseCount, 0.11F, 0.26F);
    constexpr float jointHalf = 0.0018F;  // of a repeat: 7 mm of 4 m
    return finished("paving", size, 1024, [&](float u, float v) {
        const float wobble = 0.0012F * noise.fractal(u, v, 24, 3);
        const float course = (v + wobble) * static_cast<float>(courseCount);
        const int row = (static_cast<int>(std::floor(course)) + courseCount) % courseCount;
        const auto& joints = courses[static_cast<std::size_t>(row)];
        const float across = u + wobble - std::floor(u + wobble);
        const auto next = std::upper_bound(joints.begin(), joints.end(), across);
        const int slab = next == joints.begin() ? static_cast<int>(joints.size()) - 1
                                                : static_cast<int>(next - joints.begin()) - 1;
        const float after = next == joints.end() ? joints.front() + 1.0F : *next;
        const float before = next == joints.begin() ? joints.back() - 1.0F : *(next - 1);
        const float fromCourse = course - std::floor(course);
        const float edge =
            std::min({after - across, across - before,
                      std::min(fromCourse, 1.0F - fromCourse) / static_cast<float>(courseCount)});
        const float worn = 0.0015F + 0.0012F * noise.fractal(u, v, 16, 3);
        const float top = ramp(jointHalf * 0.5F, jointHalf + worn + 0.0012F, edge);
        const float tone = noise.cell(row * 37 + 5, slab);
        const float hue = noise.cell(row * 37 + 19, slab);
        const float cloud = noise.fractal(u, v, 4, 6);
        const float grain = noise.fractal(u, v, 64, 3);
        const float pits = ramp(0.42F, 0.6F, noise.fractal(u, v, 48, 2) + 0.05F * cloud);
        glm::vec3 stone =
            glm::mix(glm::vec3{0.80F, 0.73F, 0.62F}, glm::vec3{0.86F, 0.80F, 0.71F}, tone);
        stone = glm::mix(stone, glm::vec3{0.80F, 0.68F, 0.57F}, 0.55F * ramp(0.6F, 1.0F, hue));
        stone *= 1.0F + 0.10F * cloud + 0.07F * grain - 0.10F * pits;
        const glm::vec3 joint = glm::vec3{0.56F, 0.49F, 0.41F} * (1.0F + 0.2F * grain);
        // Slabs have settled a little, each its own way.
        const float tilt = (noise.cell(row, slab + 71) - 0.5F) * (fromCourse - 0.5F) * 3.0F;
        return Texel{.colour = glm::mix(joint, stone, top),
                     .height = 3.2F * top + tilt + 0.9F * grain + 1.2F * cloud - 1.4F * pits};
    });
}

Texture travertine(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 2};
    return finished("travertine", size, 512, [&](float u, float v) {
        const float warp = 0.03F * noise.fractal(u, v, 4, 3);
        const float bands = noise.fractal(u, v + warp, 2, 14, 4);
        const float grain = noise.fractal(u, v, 48, 3);
        const float holes = ramp(0.34F, 0.5F, noise.fractal(u, v + warp, 14, 48, 2));
        const float stain = noise.fractal(u, v, 3, 5);
        glm::vec3 colour =
            glm::mix(glm::vec3{0.875F, 0.81F, 0.70F}, glm::vec3{0.92F, 0.865F, 0.77F},
                     std::clamp(0.5F + 0.9F * bands, 0.0F, 1.0F));
        colour *= 1.0F + 0.05F * grain + 0.08F * stain - 0.24F * holes;
        return Texel{.colour = colour, .height = 0.7F * grain + 0.6F * bands - 1.8F * holes};
    });
}

Texture marble(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 3};
    return finished("marble", size, 512, [&](float u, float v) {
        const float warpU = 0.10F * noise.fractal(u, v, 3, 5);
        const float warpV = 0.10F * noise.fractal(v, u, 3, 5);
        const auto vein = [&](int cells, float width) {
            return 1.0F - ramp(0.0F, width, std::abs(noise.at(u + warpU, v + warpV, cells)));
        };
        const float cloud = noise.fractal(u + warpU, v, 2, 5);
        const float veins = 0.65F * vein(3, 0.07F) + 0.35F * vein(7, 0.09F);
        const float wear = noise.fractal(u, v, 24, 4);
        glm::vec3 colour = glm::vec3{0.93F, 0.91F, 0.87F} * (1.0F + 0.06F * cloud + 0.02F * wear);
        colour = glm::mix(colour, glm::vec3{0.62F, 0.61F, 0.60F}, 0.55F * veins);
        return Texel{.colour = colour, .height = 0.35F * wear};
    });
}

Texture plaster(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 4};
    return finished("plaster", size, 512, [&](float u, float v) {
        const float patches = noise.fractal(u, v, 3, 6);
        const float trowel = noise.fractal(u + 0.04F * patches, v, 10, 24, 3);
        const float grain = noise.fractal(u, v, 64, 2);
        const float streaks = ramp(0.12F, 0.5F, noise.fractal(u, v, 22, 2, 3));
        glm::vec3 colour = glm::mix(glm::vec3{0.85F, 0.64F, 0.42F}, glm::vec3{0.93F, 0.77F, 0.57F},
                                    std::clamp(0.5F + patches, 0.0F, 1.0F));
        colour *= 1.0F + 0.04F * trowel + 0.05F * grain - 0.10F * streaks;
        return Texel{.colour = colour, .height = 2.2F * patches + 1.1F * trowel + 0.8F * grain};
    });
}

Texture terracotta(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 5};
    return finished("terracotta", size, 512, [&](float u, float v) {
        const float rings = noise.fractal(u, v, 2, 40, 3);
        const float cloud = noise.fractal(u, v, 3, 5);
        const float grain = noise.fractal(u, v, 56, 2);
        const float lime = ramp(0.15F, 0.5F, noise.fractal(u, v, 5, 5) - 0.1F * rings);
        glm::vec3 colour = glm::mix(glm::vec3{0.74F, 0.47F, 0.32F}, glm::vec3{0.86F, 0.60F, 0.44F},
                                    std::clamp(0.5F + cloud, 0.0F, 1.0F));
        colour *= 1.0F + 0.07F * rings + 0.06F * grain;
        colour = glm::mix(colour, glm::vec3{0.86F, 0.76F, 0.66F}, 0.45F * lime);
        return Texel{.colour = colour, .height = 1.6F * rings + 0.7F * grain};
    });
}

Texture bronze(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 6};
    return finished("bronze", size, 512, [&](float u, float v) {
        const float cloud = noise.fractal(u, v, 3, 6);
        const float runs = noise.fractal(u, v, 20, 3, 4);
        const float grain = noise.fractal(u, v, 40, 3);
        const float green = ramp(0.08F, 0.42F, 0.7F * cloud + 0.6F * runs);
        glm::vec3 colour = glm::mix(glm::vec3{0.55F, 0.38F, 0.20F}, glm::vec3{0.70F, 0.51F, 0.28F},
                                    std::clamp(0.5F + cloud + 0.3F * grain, 0.0F, 1.0F));
        colour = glm::mix(colour, glm::vec3{0.37F, 0.57F, 0.48F}, 0.75F * green);
        return Texel{.colour = colour * (1.0F + 0.08F * grain),
                     .height = 0.9F * grain + 1.2F * green};
    });
}

Texture roof(std::uint64_t seed, std::uint32_t size) {
    const Noise noise{seed * 31 + 7};
    return finished("roof", size, 512, [&](float u, float v) {
        constexpr int across = 8;
        constexpr int down = 6;
        const float x = u * across;
        const float y = v * down;
        const float side = x - std::floor(x) - 0.5F;
        const float round = std::sqrt(std::max(0.0F, 1.0F - 4.0F * side * side));
        const float lap = y - std::floor(y);
        const int column = static_cast<int>(std::floor(x)) % across;
        const int row = static_cast<int>(std::floor(y)) % down;
        const float tone = noise.cell(column + 3, row + 9);
        const float grain = noise.fractal(u, v, 40, 3);
        glm::vec3 colour =
            glm::mix(glm::vec3{0.63F, 0.32F, 0.20F}, glm::vec3{0.82F, 0.51F, 0.35F}, tone);
        colour *= 0.55F + 0.45F * std::min(round * 1.4F, 1.0F);
        colour *= (1.0F - 0.45F * ramp(0.90F, 1.0F, lap)) * (1.0F + 0.12F * grain);
        return Texel{.colour = colour, .height = 14.0F * round + 5.0F * lap + grain};
    });
}

}  // namespace gnomon::demo
