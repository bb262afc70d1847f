// A horizontal sundial that tells the plaza's time: its style points to the celestial pole, and
// its hour lines are those of the plaza's latitude. Dial coordinates: X east, Y up, -Z north.
#include <gnomon/demo/Scenes.h>
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string_view>

#include "Parts.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float dialHeight = 0.70F;
constexpr float bladeLength = 6.3F;
constexpr float bladeHalfWidth = 0.19F;
constexpr float footSouth = 2.8F;  ///< of the dial's middle: the point all lines run to
constexpr float inlay = 0.012F;    ///< how far inlays stand out

/// Puts a prism's X, Y on the dial as (right, outward) and its Z up.
glm::mat4 lying(const glm::vec3& at, const glm::vec3& outward) {
    const glm::vec3 up{0.0F, 1.0F, 0.0F};
    const glm::vec3 right = glm::normalize(glm::cross(outward, up));
    return glm::mat4{glm::vec4{right, 0.0F}, glm::vec4{glm::normalize(outward), 0.0F},
                     glm::vec4{up, 0.0F}, glm::vec4{at, 1.0F}};
}

Mesh platform(const Finish& stone) {
    std::vector<glm::vec2> profile{{0.0F, -0.1F}, {10.5F, -0.1F}};
    const auto step = [&](float radius, float top) {
        profile.insert(profile.end(), {{radius, top - 0.03F}, {radius - 0.03F, top}});
    };
    step(10.5F, 0.18F);
    profile.emplace_back(9.95F, 0.18F);
    step(9.95F, 0.36F);
    profile.emplace_back(9.4F, 0.36F);
    step(9.4F, 0.54F);
    profile.emplace_back(0.0F, 0.54F);
    return lathe(profile, {.segments = 120, .uvPerMetre = stone.uvPerMetre, .crease = 0.4F});
}

Mesh dial(const Finish& stone) {
    const std::array<glm::vec2, 7> profile{{{0.0F, 0.50F},
                                            {8.55F, 0.50F},
                                            {8.55F, 0.56F},
                                            {8.70F, 0.60F},
                                            {8.70F, 0.67F},
                                            {8.67F, dialHeight},
                                            {0.0F, dialHeight}}};
    // The top is a fan from the middle, so its texture is laid on flat, not round.
    Mesh mesh = lathe(profile, {.segments = 120, .uvPerMetre = stone.uvPerMetre, .crease = 0.3F});
    for (Vertex& v : mesh.vertices) {
        if (v.normal.y > 0.9F) v.uv = planarUv(v.position, {0.0F, 1.0F, 0.0F}, stone.uvPerMetre);
    }
    return mesh;
}

Mesh ring(float inner, float outer) {
    const float low = dialHeight - 0.05F;
    const float high = dialHeight + inlay;
    const std::array<glm::vec2, 5> profile{
        {{inner, low}, {outer, low}, {outer, high}, {inner, high}, {inner, low}}};
    return lathe(profile, {.segments = 120, .uvPerMetre = 1.0F});
}

/// The blade's outline: (distance north of the foot, height). The straight side is the style.
std::vector<glm::vec2> bladeOutline(float latitude) {
    const glm::vec2 top{bladeLength, bladeLength * std::tan(latitude)};
    std::vector<glm::vec2> outline{{0.0F, 0.0F}};
    const glm::vec2 heel{0.66F * bladeLength, 0.0F};
    const glm::vec2 bend{0.70F * bladeLength, 0.62F * top.y};
    for (int i = 0; i <= 20; ++i) {
        const float t = static_cast<float>(i) / 20.0F;
        outline.push_back(heel * (1 - t) * (1 - t) + bend * 2.0F * t * (1 - t) + top * t * t);
    }
    return outline;
}

/// Middle of the largest circle in the triangle foot, heel, style: insets shrink towards it.
constexpr glm::vec2 bladeMiddle{0.485F * bladeLength, 0.185F * bladeLength};

std::vector<glm::vec2> shrunk(const std::vector<glm::vec2>& outline, float factor) {
    std::vector<glm::vec2> result;
    for (const glm::vec2& p : outline) result.push_back(bladeMiddle + (p - bladeMiddle) * factor);
    return result;
}

/// A rim of full thickness; inside it a thinner panel with a round eye that lets the sun through.
Mesh blade(float latitude, const Finish& metal) {
    const std::vector<glm::vec2> outline = bladeOutline(latitude);
    const std::vector<glm::vec2> inner = shrunk(outline, 0.86F);
    std::vector<glm::vec2> rim{outline[0], inner[0]};
    rim.insert(rim.end(), inner.rbegin(), inner.rend());  // clockwise, ends where it began
    rim.insert(rim.end(), outline.begin(), outline.end());
    Mesh mesh = prism(rim, -bladeHalfWidth, bladeHalfWidth, metal.uvPerMetre);

    const float eye = 0.105F * bladeLength;
    std::vector<glm::vec2> panel = shrunk(outline, 0.93F);
    const glm::vec2 slit{bladeMiddle.x, panel[0].y};
    std::vector<glm::vec2> slitted{panel[0], slit};
    constexpr int eyeCorners = 36;
    for (int i = 0; i <= eyeCorners; ++i) {
        const float angle = -pi / 2 - 2 * pi * static_cast<float>(i % eyeCorners) / eyeCorners;
        slitted.push_back(bladeMiddle + eye * glm::vec2{std::cos(angle), std::sin(angle)});
    }
    slitted.push_back(slit);
    slitted.insert(slitted.end(), panel.begin() + 1, panel.end());
    append(mesh, prism(slitted, -0.09F, 0.09F, metal.uvPerMetre));

    const glm::mat4 upright =
        glm::rotate(glm::translate(glm::mat4{1.0F}, glm::vec3{bladeMiddle, 0.0F}), pi / 2,
                    glm::vec3{1.0F, 0.0F, 0.0F});
    append(mesh, torus(eye + 0.03F, 0.13F, 48, 12, metal.uvPerMetre), upright);
    // X north, Y up, Z east.
    const glm::mat4 dialFromBlade{glm::vec4{0, 0, -1, 0}, glm::vec4{0, 1, 0, 0},
                                  glm::vec4{1, 0, 0, 0}, glm::vec4{0, dialHeight, footSouth, 1}};
    Mesh placed;
    append(placed, mesh, dialFromBlade);
    return placed;
}

/// Where the line from @p foot along @p direction (unit) leaves a circle round the dial's middle.
float reachOf(const glm::vec3& foot, const glm::vec3& direction, float radius) {
    const float along = glm::dot(foot, direction);
    const float inside = along * along - glm::dot(foot, foot) + radius * radius;
    return -along + std::sqrt(std::max(inside, 0.0F));
}

/// A bar lying on the dial.
void addBar(Mesh& mesh, const glm::vec3& from, const glm::vec3& direction, float length,
            float width, float top) {
    append(mesh, box({-width / 2, 0.0F, -0.05F}, {width / 2, length, top}, 1.0F),
           lying(from + glm::vec3{0.0F, dialHeight, 0.0F}, direction));
}

/// Roman numerals as bars; each glyph's advance is its width. Metres, middle at 0, 0.
Mesh numeral(std::string_view text) {
    constexpr float height = 0.95F;
    constexpr float slant = 0.30F;  // half of the width of X and V
    float width = 0.0F;
    const auto advance = [](char c) { return c == 'I' ? 0.24F : 2.0F * slant + 0.18F; };
    for (const char c : text) width += advance(c);
    Mesh mesh;
    float pen = -width / 2;
    float top = inlay;
    const auto stroke = [&](glm::vec2 from, glm::vec2 to, float breadth) {
        top += 0.0004F;  // crossing strokes must not share a plane
        const glm::vec2 half{breadth / 2, 0.0F};
        const std::array<glm::vec2, 4> outline{from - half, from + half, to + half, to - half};
        append(mesh, prism(outline, -0.05F, top, 1.0F));
    };
    for (const char c : text) {
        const float x = pen + advance(c) / 2;
        const float h = height / 2;
        if (c == 'I') stroke({x, -h}, {x, h}, 0.12F);
        if (c == 'V') {
            stroke({x, -h}, {x + slant, h}, 0.08F);
            stroke({x, -h}, {x - slant, h}, 0.14F);
        }
        if (c == 'X') {
            stroke({x - slant, -h}, {x + slant, h}, 0.08F);
            stroke({x + slant, -h}, {x - slant, h}, 0.14F);
        }
        pen += advance(c);
    }
    return mesh;
}

struct Markings {
    Mesh lines = {};
    Mesh numerals = {};
};

Markings markings(double latitude) {
    static constexpr std::array<std::string_view, 15> names{"V",   "VI",   "VII", "VIII", "IX",
                                                            "X",   "XI",   "XII", "I",    "II",
                                                            "III", "IIII", "V",   "VI",   "VII"};
    Markings result;
    for (int half = -14; half <= 14; ++half) {  // half hours from noon
        const double hourAngle = half * std::numbers::pi / 24.0;
        const auto angle = static_cast<float>(hourLine(latitude, hourAngle));
        const glm::vec3 direction = onCircle(1.0F, angle);
        const bool isHour = half % 2 == 0;
        // The shadow's edge comes from the blade's far side: east of noon in the afternoon.
        for (const float side : {-1.0F, 1.0F}) {
            if ((half < 0 && side > 0) || (half > 0 && side < 0)) continue;
            const glm::vec3 foot{side * bladeHalfWidth, 0.0F, footSouth};
            const float start = isHour ? 1.3F : 4.4F;
            addBar(result.lines, foot + direction * start, direction,
                   reachOf(foot, direction, 7.0F) - start, isHour ? 0.075F : 0.035F,
                   inlay + 0.0001F * static_cast<float>(half + 20));
        }
        if (!isHour) continue;
        const glm::vec3 foot{0.0F, 0.0F, footSouth};
        const glm::vec3 at = foot + direction * reachOf(foot, direction, 7.72F);
        append(result.numerals, numeral(names[static_cast<std::size_t>(half / 2 + 7)]),
               lying(at + glm::vec3{0.0F, dialHeight, 0.0F}, at));
    }
    return result;
}

/// A sun with rays in the part of the dial that never shows an hour.
void addMosaic(Mesh& gold, Mesh& clay) {
    const glm::vec3 middle{0.0F, dialHeight, 5.4F};
    std::vector<glm::vec2> disc;
    for (int i = 0; i < 40; ++i) {
        const float angle = 2 * pi * static_cast<float>(i) / 40.0F;
        disc.emplace_back(0.62F * std::cos(angle), 0.62F * std::sin(angle));
    }
    append(gold, prism(disc, -0.05F, inlay, 1.0F), lying(middle, {0, 0, -1}));
    for (int i = 0; i < 16; ++i) {
        const float angle = 2 * pi * static_cast<float>(i) / 16.0F;
        const bool isLong = i % 2 == 0;
        const std::array<glm::vec2, 3> ray{
            glm::vec2{-0.15F, 0.74F}, {0.15F, 0.74F}, {0.0F, isLong ? 1.75F : 1.30F}};
        append(isLong ? gold : clay, prism(ray, -0.05F, inlay, 1.0F),
               lying(middle, onCircle(1.0F, angle)));
    }
}

}  // namespace

void addSundial(Scene& scene, const Materials& m) {
    const double latitude = plazaTime().latitude;
    Markings marks = markings(latitude);
    Mesh rings = ring(7.02F, 7.12F);
    append(rings, ring(8.32F, 8.46F));
    append(rings, marks.numerals);
    Mesh gilded;
    Mesh clay;
    addMosaic(gilded, clay);
    const auto part = [](Mesh mesh, const Finish& finish) {
        return Primitive{.mesh = welded(mesh), .material = finish.material};
    };
    const Index mesh = scene.add(MeshObject{
        .name = "sundial",
        .primitives = {part(platform(m.travertine), m.travertine), part(dial(m.marble), m.marble),
                       part(rings, m.darkMarble), part(marks.lines, m.bronze), part(gilded, m.gold),
                       part(clay, m.terracotta),
                       part(blade(static_cast<float>(latitude), m.bronze), m.bronze)}});
    scene.add(Node{.name = "sundial",
                   .rotation = lookingAlong(onCircle(1.0F, static_cast<float>(plazaNorth()))),
                   .mesh = mesh});
}

}  // namespace gnomon::demo
