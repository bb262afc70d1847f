// Two curved wings of fluted columns under an entablature; behind the right one a portico.
// Proportions of the Roman Doric order after Vignola: a column of eight diameters.
// Source: Giacomo Barozzi da Vignola. Regola delli cinque ordini d'architettura. 1562
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float lowerRadius = 0.44F;
constexpr float upperRadius = 0.365F;
constexpr float shaftFoot = 0.50F;
constexpr float shaftTop = 6.45F;
constexpr float columnHeight = 7.0F;

/// Radius of the shaft without flutes at height part @p t: straight for a third, then a
/// swelling curve (entasis).
float entasis(float t) {
    const float rise = std::max(0.0F, (t - 1.0F / 3.0F) * 1.5F);
    return lowerRadius - (lowerRadius - upperRadius) * rise * rise;
}

Mesh shaft(float uvPerMetre) {
    constexpr int flutes = 20;
    constexpr int stepsPerFlute = 4;
    constexpr int columns = flutes * stepsPerFlute;
    // The flutes run out in the two end rows, so that the shaft's ends are round.
    static constexpr std::array<float, 9> heights{0.0F,  0.015F, 0.05F, 0.33F, 0.5F,
                                                  0.66F, 0.82F,  0.96F, 1.0F};
    constexpr int rows = static_cast<int>(heights.size());
    Mesh mesh;
    addGrid(mesh, rows + 1, columns, true, [&](int row, int column) {
        const int level = std::clamp(row - 1, 0, rows - 1);
        const float t = heights[static_cast<std::size_t>(level)];
        const float y = shaftFoot + t * (shaftTop - shaftFoot);
        const bool isEnd = level == 0 || level == 1 || level == rows - 1;
        const float across = static_cast<float>(column % stepsPerFlute) / stepsPerFlute;
        const float hollow = isEnd ? 0.0F : 0.036F * std::sin(pi * across);
        const bool isPole = row == 0 || row == rows + 1;
        const float radius = isPole ? 0.0F : entasis(t) - hollow;
        const float turn = static_cast<float>(column) / columns;
        return Vertex{{radius * std::cos(turn * 2 * pi), y, -radius * std::sin(turn * 2 * pi)},
                      {},
                      {turn * 2.0F, -y * uvPerMetre}};
    });
    return shaded(mesh, 0.75F);
}

Mesh column(const Finish& stone) {
    const float uv = stone.uvPerMetre;
    const LatheOptions options{.segments = 40, .uvPerMetre = uv, .crease = 0.7F};
    Mesh mesh = box({-0.62F, -0.02F, -0.62F}, {0.62F, 0.18F, 0.62F}, uv, 0.015F);
    // Attic base: torus, hollow, smaller torus.
    const std::array<glm::vec2, 15> base{{{0.0F, 0.17F},
                                          {0.55F, 0.17F},
                                          {0.60F, 0.20F},
                                          {0.615F, 0.25F},
                                          {0.60F, 0.30F},
                                          {0.55F, 0.33F},
                                          {0.52F, 0.335F},
                                          {0.495F, 0.37F},
                                          {0.50F, 0.405F},
                                          {0.53F, 0.42F},
                                          {0.545F, 0.45F},
                                          {0.53F, 0.48F},
                                          {0.49F, 0.50F},
                                          {0.46F, 0.53F},
                                          {0.0F, 0.54F}}};
    append(mesh, lathe(base, options));
    append(mesh, shaft(uv));
    const std::array<glm::vec2, 12> capital{{{0.0F, 6.40F},
                                             {0.38F, 6.41F},
                                             {0.405F, 6.44F},
                                             {0.405F, 6.47F},
                                             {0.375F, 6.49F},
                                             {0.375F, 6.62F},
                                             {0.40F, 6.64F},
                                             {0.40F, 6.67F},
                                             {0.50F, 6.75F},
                                             {0.545F, 6.80F},
                                             {0.55F, 6.84F},
                                             {0.0F, 6.85F}}};
    append(mesh, lathe(capital, options));
    append(mesh, box({-0.60F, 6.83F, -0.60F}, {0.60F, columnHeight, 0.60F}, uv, 0.02F));
    return welded(mesh);
}

/// Outline of the entablature across the wing: architrave in two steps, frieze, cornice.
std::vector<glm::vec2> entablature() {
    constexpr float axis = site::colonnadeRadius;
    const float y = site::stylobate + columnHeight;
    // Half of the outline, away from the axis; mirrored for the other face.
    const std::array<glm::vec2, 11> half{{{0.43F, -0.01F},
                                          {0.43F, 0.26F},
                                          {0.47F, 0.27F},
                                          {0.47F, 0.55F},
                                          {0.53F, 0.58F},
                                          {0.53F, 0.64F},
                                          {0.45F, 0.66F},
                                          {0.45F, 1.15F},
                                          {0.56F, 1.20F},
                                          {0.86F, 1.36F},
                                          {0.90F, 1.56F}}};
    std::vector<glm::vec2> outline;
    for (const glm::vec2& p : half) outline.emplace_back(axis + p.x, y + p.y);
    for (std::size_t i = half.size(); i > 0; --i) {
        outline.emplace_back(axis - half[i - 1].x, y + half[i - 1].y);
    }
    return outline;
}

struct Wing {
    const char* name = "";
    float from = 0.0F;
    float to = 0.0F;
    int columns = 0;
    float floorRadius = 0.0F;  ///< outer edge of the floor
};

void addWing(Scene& scene, const Materials& m, const Wing& wing, Index columnMesh) {
    const float uv = m.travertine.uvPerMetre;
    const int segments = static_cast<int>(std::lround((wing.to - wing.from) * 24.0F / 1.0F));
    const LatheOptions options{.segments = segments, .uvPerMetre = uv, .crease = 0.35F};
    std::vector<glm::vec2> floor{{wing.floorRadius, -0.1F}, {wing.floorRadius, site::stylobate}};
    for (int step = 2; step >= 0; --step) {
        const float inner = 22.3F + 0.36F * static_cast<float>(step);
        const float top = site::stylobate * static_cast<float>(step + 1) / 3.0F;
        floor.insert(floor.end(), {{inner + 0.025F, top}, {inner, top - 0.025F}});
        if (step > 0) floor.emplace_back(inner, top - site::stylobate / 3.0F);
    }
    floor.emplace_back(22.3F, -0.1F);
    Mesh stone = arc(floor, wing.from, wing.to, options);
    append(stone, arc(entablature(), wing.from, wing.to, options));
    // Dentils under the cornice of the inner face.
    const int dentils =
        static_cast<int>((wing.to - wing.from) * (site::colonnadeRadius - 0.55F) / 0.36F);
    const float y = site::stylobate + columnHeight;
    for (int i = 0; i < dentils; ++i) {
        const float angle = wing.from + (wing.to - wing.from) * (static_cast<float>(i) + 0.5F) /
                                            static_cast<float>(dentils);
        append(stone,
               box({-0.09F, y + 1.17F, -(site::colonnadeRadius - 0.4F)},
                   {0.09F, y + 1.34F, -(site::colonnadeRadius - 0.69F)}, uv),
               turned(angle));
    }
    scene.add(Node{.name = wing.name,
                   .mesh = scene.add(wing.name, welded(stone), m.travertine.material)});
    const float margin = 0.045F;
    for (int i = 0; i < wing.columns; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(wing.columns - 1);
        const float angle = wing.from + margin + part * (wing.to - wing.from - 2.0F * margin);
        scene.add(Node{.name = "column",
                       .translation = onCircle(site::colonnadeRadius, angle, site::stylobate),
                       .rotation = lookingAlong(onCircle(1.0F, angle)),
                       .mesh = columnMesh});
    }
}

}  // namespace

void addColonnade(Scene& scene, const Materials& m) {
    const Index columnMesh = scene.add("column", column(m.travertine), m.travertine.material);
    addWing(scene, m,
            {.name = "left wing",
             .from = site::leftWingEnd,
             .to = -site::gateHalfAngle - 0.01F,
             .columns = 14,
             .floorRadius = 25.7F},
            columnMesh);
    addWing(scene, m,
            {.name = "right wing",
             .from = site::gateHalfAngle + 0.01F,
             .to = site::rightWingEnd,
             .columns = 12,
             .floorRadius = 28.9F},
            columnMesh);
}

void addPortico(Scene& scene, const Materials& m) {
    const float from = site::gateHalfAngle + 0.02F;
    const float to = site::rightWingEnd - 0.01F;
    const float inner = site::wallRadius;
    const LatheOptions options{.segments = 30, .uvPerMetre = m.plaster.uvPerMetre};
    const std::array<glm::vec2, 4> wall{
        {{inner, -0.1F}, {28.85F, -0.1F}, {28.85F, 8.45F}, {inner, 8.45F}}};
    scene.add(
        Node{.name = "portico wall",
             .mesh = scene.add("portico wall", arc(wall, from, to, options), m.plaster.material)});
    const LatheOptions stoneOptions{.segments = 30, .uvPerMetre = m.travertine.uvPerMetre};
    const auto band = [&](float depth, float low, float high) {
        const std::array<glm::vec2, 4> outline{
            {{inner - depth, low}, {28.95F, low}, {28.95F, high}, {inner - depth, high}}};
        return arc(outline, from - 0.003F, to + 0.003F, stoneOptions);
    };
    Mesh trim = band(0.10F, 0.40F, 1.10F);
    append(trim, band(0.18F, 8.40F, 8.75F));
    append(trim, band(0.06F, 5.55F, 5.75F));
    Mesh panels;
    Mesh beams;
    constexpr int bays = 11;
    for (int i = 0; i < bays; ++i) {
        const float part = (static_cast<float>(i) + 0.5F) / bays;
        const float angle = from + part * (to - from);
        // A blind arch: a flat frame, and in it a darker field.
        const auto archway = [](float half, float spring) {
            std::vector<glm::vec2> outline{{-half, 1.0F}, {half, 1.0F}};
            for (int k = 0; k <= 14; ++k) {
                const float turn = pi * static_cast<float>(k) / 14.0F;
                outline.emplace_back(half * std::cos(turn), spring + half * std::sin(turn));
            }
            return outline;
        };
        append(trim,
               prism(archway(0.86F, 4.0F), -inner - 0.2F, -inner + 0.10F, m.travertine.uvPerMetre),
               turned(angle));
        append(panels,
               prism(archway(0.66F, 4.0F), -inner - 0.1F, -inner + 0.13F, m.plaster.uvPerMetre),
               turned(angle));
    }
    for (int i = 0; i < 2 * bays + 1; ++i) {
        const float angle = from + static_cast<float>(i) / (2.0F * bays) * (to - from);
        append(beams,
               box({-0.11F, 8.98F, -28.75F}, {0.11F, 9.28F, -22.9F}, m.wood.uvPerMetre, 0.01F),
               turned(angle));
    }
    scene.add(Node{.name = "portico trim",
                   .mesh = scene.add("portico trim", welded(trim), m.travertine.material)});
    scene.add(Node{.name = "portico fields",
                   .mesh = scene.add("portico fields", welded(panels), m.terracotta.material)});
    scene.add(Node{.name = "portico beams",
                   .mesh = scene.add("portico beams", welded(beams), m.wood.material)});
}

}  // namespace gnomon::demo
