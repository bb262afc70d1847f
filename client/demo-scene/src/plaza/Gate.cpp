// The gate in the axis of the view: three archways, half columns, an attic, lanterns in the arches.
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float front = -22.6F;  ///< z of the face towards the sundial
constexpr float back = -26.8F;
constexpr float halfWidth = 6.9F;
constexpr float bodyHeight = 9.3F;

struct Archway {
    float middle = 0.0F;
    float half = 0.0F;
    float spring = 0.0F;  ///< where the round part begins
};
constexpr std::array<Archway, 3> archways{
    {{-4.55F, 1.05F, 3.3F}, {0.0F, 1.85F, 4.9F}, {4.55F, 1.05F, 3.3F}}};
constexpr int archSteps = 20;

glm::vec2 onArch(const Archway& a, float radius, int step) {
    const float angle = pi * static_cast<float>(step) / archSteps;
    return {a.middle + radius * std::cos(angle), a.spring + radius * std::sin(angle)};
}

/// The gate from the front, in x and y: the archways are open at the bottom.
std::vector<glm::vec2> silhouette() {
    std::vector<glm::vec2> outline{{-halfWidth, -0.1F}};
    for (const Archway& a : archways) {
        outline.emplace_back(a.middle - a.half, -0.1F);
        for (int i = archSteps; i >= 0; --i) outline.push_back(onArch(a, a.half, i));
        outline.emplace_back(a.middle + a.half, -0.1F);
    }
    outline.insert(outline.end(),
                   {{halfWidth, -0.1F}, {halfWidth, bodyHeight}, {-halfWidth, bodyHeight}});
    return outline;
}

/// A moulding round an archway, standing out of both faces.
Mesh archivolt(const Archway& a, float uv) {
    std::vector<glm::vec2> outline;
    const float outer = a.half + 0.42F;
    const float inner = a.half - 0.04F;
    for (int i = 0; i <= archSteps; ++i) outline.push_back(onArch(a, outer, i));
    for (int i = archSteps; i >= 0; --i) outline.push_back(onArch(a, inner, i));
    Mesh mesh = prism(outline, back - 0.09F, front + 0.09F, uv);
    // Imposts, on which the round part rests, and a keystone.
    for (const float side : {-1.0F, 1.0F}) {
        const float x = a.middle + side * (a.half + 0.19F);
        append(mesh, box({x - 0.33F, a.spring - 0.26F, back - 0.15F},
                         {x + 0.33F, a.spring + 0.02F, front + 0.15F}, uv, 0.02F));
    }
    const float crown = a.spring + a.half;
    const std::array<glm::vec2, 4> key{glm::vec2{a.middle - 0.16F, crown - 0.12F},
                                       {a.middle + 0.16F, crown - 0.12F},
                                       {a.middle + 0.27F, crown + 0.62F},
                                       {a.middle - 0.27F, crown + 0.62F}};
    append(mesh, prism(key, back - 0.2F, front + 0.2F, uv));
    return mesh;
}

/// Ledges that run round the whole body.
void addLedge(Mesh& mesh, float low, float high, float out, float uv) {
    append(mesh, box({-halfWidth - out, low, back - out}, {halfWidth + out, high, front + out}, uv,
                     0.03F));
}

Mesh ornament(float uv) {
    Mesh mesh;
    for (const Archway& a : archways) append(mesh, archivolt(a, uv));
    for (const float x : {-6.35F, -2.62F, 2.62F, 6.35F}) {  // half columns on pedestals
        const glm::mat4 place = glm::translate(glm::mat4{1.0F}, glm::vec3{x, 0.0F, front + 0.05F});
        append(mesh, box({-0.55F, -0.05F, -0.4F}, {0.55F, 1.35F, 0.55F}, uv, 0.03F), place);
        const std::array<glm::vec2, 16> column{{{0.0F, 1.30F},
                                                {0.46F, 1.30F},
                                                {0.48F, 1.40F},
                                                {0.45F, 1.48F},
                                                {0.40F, 1.52F},
                                                {0.375F, 1.62F},
                                                {0.375F, 3.6F},
                                                {0.36F, 5.4F},
                                                {0.32F, 7.28F},
                                                {0.36F, 7.32F},
                                                {0.36F, 7.38F},
                                                {0.33F, 7.42F},
                                                {0.34F, 7.58F},
                                                {0.46F, 7.74F},
                                                {0.48F, 7.80F},
                                                {0.0F, 7.81F}}};
        append(mesh, lathe(column, {.segments = 32, .uvPerMetre = uv, .crease = 0.6F}), place);
        append(mesh, box({-0.54F, 7.79F, -0.4F}, {0.54F, 7.96F, 0.54F}, uv, 0.02F), place);
        append(mesh, box({-0.50F, 7.94F, -0.4F}, {0.50F, 9.28F, 0.40F}, uv, 0.02F), place);
    }
    addLedge(mesh, 8.30F, 8.46F, 0.10F, uv);
    addLedge(mesh, 9.22F, 9.46F, 0.52F, uv);
    addLedge(mesh, 9.40F, 9.62F, 0.66F, uv);
    for (int i = 0; i < 36; ++i) {  // dentils
        const float x = -6.65F + 0.38F * static_cast<float>(i);
        append(mesh, box({x - 0.1F, 9.0F, front - 0.1F}, {x + 0.1F, 9.25F, front + 0.34F}, uv));
    }
    // Attic: a higher block over the middle.
    append(mesh, box({-6.3F, 9.58F, back + 0.5F}, {6.3F, 10.5F, front - 0.5F}, uv, 0.04F));
    append(mesh, box({-6.5F, 10.45F, back + 0.3F}, {6.5F, 10.70F, front - 0.3F}, uv, 0.04F));
    append(mesh, box({-3.1F, 10.65F, back + 0.6F}, {3.1F, 11.9F, front - 0.6F}, uv, 0.04F));
    const std::array<glm::vec2, 3> pediment{
        glm::vec2{-3.6F, 12.08F}, {3.6F, 12.08F}, {0.0F, 13.35F}};
    append(mesh, box({-3.6F, 11.85F, back + 0.3F}, {3.6F, 12.12F, front - 0.3F}, uv, 0.04F));
    append(mesh, prism(pediment, back + 0.5F, front - 0.5F, uv));
    return welded(mesh);
}

/// A ring of bronze with a sphere in it, over the pediment, and one on each shoulder.
Mesh finials(float uv) {
    Mesh mesh;
    const auto put = [&](float x, float y, float size) {
        const glm::mat4 place = glm::scale(
            glm::translate(glm::mat4{1.0F}, glm::vec3{x, y, (front + back) / 2}), glm::vec3{size});
        append(mesh,
               lathe(std::array<glm::vec2, 6>{{{0.0F, -0.1F},
                                               {0.3F, -0.1F},
                                               {0.3F, 0.05F},
                                               {0.1F, 0.15F},
                                               {0.1F, 0.45F},
                                               {0.0F, 0.46F}}},
                     {.segments = 24, .uvPerMetre = uv}),
               place);
        append(mesh, sphere(0.3F, 24, 16, uv), glm::translate(place, glm::vec3{0.0F, 0.7F, 0.0F}));
    };
    put(0.0F, 13.2F, 1.4F);
    put(-5.6F, 10.68F, 1.1F);
    put(5.6F, 10.68F, 1.1F);
    return welded(mesh);
}

struct Lantern {
    Mesh iron = {};
    Mesh glass = {};
};

/// A six-sided lantern that hangs from its origin; the chain is @p drop metres long.
Lantern lantern(float drop) {
    Lantern result;
    const std::array<glm::vec3, 2> chain{glm::vec3{0.0F, 0.05F, 0.0F}, {0.0F, -drop, 0.0F}};
    result.iron = tube(chain, std::array{0.018F, 0.018F}, 8, 1.0F);
    const glm::mat4 place = glm::translate(glm::mat4{1.0F}, glm::vec3{0.0F, -drop, 0.0F});
    const LatheOptions six{.segments = 6, .crease = 0.2F};
    const auto turnedSolid = [&](std::initializer_list<glm::vec2> profile) {
        return lathe(std::vector<glm::vec2>{profile}, six);
    };
    append(result.iron,
           turnedSolid(
               {{0.0F, -0.16F}, {0.32F, -0.19F}, {0.32F, -0.15F}, {0.07F, 0.05F}, {0.0F, 0.06F}}),
           place);
    append(result.iron,
           turnedSolid({{0.0F, -0.76F}, {0.17F, -0.76F}, {0.20F, -0.72F}, {0.0F, -0.71F}}), place);
    for (int i = 0; i < 6; ++i) {
        const float angle = pi / 3.0F * static_cast<float>(i);
        const auto at = [&](float radius, float y) {
            return glm::vec3{radius * std::cos(angle), y, -radius * std::sin(angle)};
        };
        append(result.iron,
               tube(std::array{at(0.27F, -0.17F), at(0.18F, -0.74F)}, std::array{0.014F, 0.014F}, 6,
                    1.0F),
               place);
    }
    append(result.glass,
           turnedSolid({{0.0F, -0.70F}, {0.155F, -0.70F}, {0.235F, -0.20F}, {0.0F, -0.20F}}),
           place);
    return result;
}

void addLanterns(Scene& scene, const Materials& m) {
    constexpr float drop = 1.1F;
    const Lantern shape = lantern(drop);
    const Index mesh = scene.add(
        MeshObject{.name = "lantern",
                   .primitives = {{.mesh = welded(shape.iron), .material = m.iron.material},
                                  {.mesh = welded(shape.glass), .material = m.lamp.material}}});
    for (const Archway& a : archways) {
        const bool isMain = a.middle == 0.0F;
        const float crown = a.spring + a.half;
        const Index node =
            scene.add(Node{.name = "lantern",
                           .translation = {a.middle, crown, (front + back) / 2 + 0.6F},
                           .mesh = mesh});
        // The light sits under the lantern's floor, so that its own bars do not stand in its way.
        const float reach = crown - drop - 0.8F;
        const Index light = scene.add(Light{.name = isMain ? "gate lantern" : "side lantern",
                                            .kind = Light::Kind::spot,
                                            .colour = {1.0F, 0.66F, 0.34F},
                                            .intensity = isMain ? 40.0F : 20.0F,
                                            .range = 3.0F * reach,
                                            .innerCone = 0.45F,
                                            .outerCone = 0.80F});
        scene.add(Node{.name = "lantern light",
                       .translation = {0.0F, -drop - 0.80F, 0.0F},
                       .rotation = lookingAlong({0.0F, -1.0F, 0.0F}),
                       .light = light},
                  node);
    }
}

}  // namespace

void addGate(Scene& scene, const Materials& m) {
    const Mesh body = prism(silhouette(), back, front, m.plaster.uvPerMetre);
    scene.add(Node{.name = "gate", .mesh = scene.add("gate", body, m.plaster.material)});
    scene.add(Node{.name = "gate ornament",
                   .mesh = scene.add("gate ornament", ornament(m.travertine.uvPerMetre),
                                     m.travertine.material)});
    scene.add(
        Node{.name = "gate finials",
             .mesh = scene.add("gate finials", finials(m.bronze.uvPerMetre), m.bronze.material)});
    addLanterns(scene, m);
    // Jars to the side of each smaller archway's middle: the lanterns throw their shadows.
    const Index jar =
        scene.add("gate jar", amphora(1.25F, m.terracotta.uvPerMetre), m.terracotta.material);
    for (const glm::vec3& at : {glm::vec3{-4.95F, 0.0F, -24.5F},
                                {-4.2F, 0.0F, -25.2F},
                                {4.95F, 0.0F, -24.3F},
                                {-1.25F, 0.0F, -24.9F},
                                {1.3F, 0.0F, -24.6F}}) {
        scene.add(Node{.name = "gate jar", .translation = at, .mesh = jar});
    }
}

void addBanners(Scene& scene, const Materials& m) {
    // Cloth hung from a rod, in folds that grow downwards; open, seen from both sides.
    constexpr float width = 1.15F;
    constexpr float length = 3.45F;
    Mesh cloth;
    addGrid(cloth, 24, 10, false, [&](int row, int column) {
        const float down = 1.0F - static_cast<float>(row) / 24.0F;
        const float across = static_cast<float>(column) / 10.0F;
        const float fold = 0.07F * (0.2F + down) * std::sin(across * 9.0F + down * 1.6F);
        const float notch = 0.28F * down * (1.0F - std::abs(2.0F * across - 1.0F));  // swallowtail
        return Vertex{
            {(across - 0.5F) * width, -down * (length - notch), fold}, {}, {across, down}};
    });
    cloth = shaded(cloth, 1.2F);
    Mesh rod = tube(std::array{glm::vec3{-0.72F, 0.02F, 0.0F}, glm::vec3{0.72F, 0.02F, 0.0F}},
                    std::array{0.03F, 0.03F}, 10, 1.0F);
    for (const float side : {-1.0F, 1.0F}) {
        append(rod, sphere(0.06F, 12, 8, 1.0F),
               glm::translate(glm::mat4{1.0F}, glm::vec3{side * 0.74F, 0.02F, 0.0F}));
    }
    const Index mesh = scene.add(
        MeshObject{.name = "banner",
                   .primitives = {{.mesh = cloth, .material = m.banner.material, .closed = false},
                                  {.mesh = welded(rod), .material = m.gold.material}}});
    const Index bracket =
        scene.add("banner bracket",
                  tube(std::array{glm::vec3{0.0F, 0.0F, -0.75F}, glm::vec3{0.0F, 0.0F, 0.02F}},
                       std::array{0.03F, 0.03F}, 8, 1.0F),
                  m.iron.material);
    int count = 0;
    for (const float x : {-4.55F, 4.55F}) {
        const glm::vec3 at{x, 8.15F, front + 0.62F};
        scene.add(Node{.name = "banner bracket", .translation = at, .mesh = bracket});
        const Index node = scene.add(Node{.name = "banner", .translation = at, .mesh = mesh});
        addSwinging(scene, node, {1.0F, 0.0F, 0.0F}, 0.10F, 6, 0.35F * static_cast<float>(count++));
    }
}

}  // namespace gnomon::demo
