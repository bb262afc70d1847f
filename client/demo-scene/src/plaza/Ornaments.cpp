// Fountain, armillary sphere, jars.
#include <gnomon/demo/Scenes.h>
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A jet of water from @p from to @p to, @p rise metres above the line between them.
Mesh jet(const glm::vec3& from, const glm::vec3& to, float rise) {
    std::vector<glm::vec3> path;
    std::vector<float> radii;
    constexpr int steps = 12;
    for (int i = 0; i <= steps; ++i) {
        const float t = static_cast<float>(i) / steps;
        path.push_back(glm::mix(from, to, t) + glm::vec3{0.0F, 4.0F * rise * t * (1.0F - t), 0.0F});
        radii.push_back(0.012F + 0.014F * t);
    }
    return tube(path, radii, 6, 1.0F);
}

/// Ring of rectangular section round Y.
Mesh hoop(float radius, float width, float thickness, float uv) {
    const std::array<glm::vec2, 5> profile{{{radius, -width / 2},
                                            {radius + thickness, -width / 2},
                                            {radius + thickness, width / 2},
                                            {radius, width / 2},
                                            {radius, -width / 2}}};
    return lathe(profile, {.segments = 72, .uvPerMetre = uv, .crease = 0.3F});
}

}  // namespace

Mesh amphora(float height, float uvPerMetre) {
    const std::array<glm::vec2, 13> shape{{{0.13F, 0.0F},
                                           {0.15F, 0.03F},
                                           {0.10F, 0.07F},
                                           {0.16F, 0.16F},
                                           {0.30F, 0.42F},
                                           {0.33F, 0.60F},
                                           {0.27F, 0.76F},
                                           {0.13F, 0.84F},
                                           {0.095F, 0.90F},
                                           {0.10F, 0.97F},
                                           {0.145F, 1.0F},
                                           {0.145F, 1.015F},
                                           {0.10F, 1.02F}}};
    std::vector<glm::vec2> profile{{0.0F, 0.0F}};
    for (const glm::vec2& p : rounded(shape, 3)) profile.push_back(p);
    profile.insert(profile.end(), {{0.07F, 0.97F}, {0.06F, 0.80F}, {0.0F, 0.78F}});
    for (glm::vec2& p : profile) p *= height;
    Mesh mesh = lathe(profile, {.segments = 32, .uvPerMetre = uvPerMetre, .crease = 0.9F});
    for (const float side : {-1.0F, 1.0F}) {
        std::vector<glm::vec3> path;
        for (int i = 0; i <= 8; ++i) {
            const float t = static_cast<float>(i) / 8.0F;
            const float x = 0.10F + 0.15F * t + 0.11F * std::sin(pi * t);
            path.emplace_back(side * x * height,
                              (0.95F - 0.21F * t * t + 0.04F * std::sin(pi * t)) * height, 0.0F);
        }
        append(mesh, tube(path, std::vector<float>(path.size(), 0.022F * height), 8, uvPerMetre));
    }
    return welded(mesh);
}

void addFountain(Scene& scene, const Materials& m) {
    const float uv = m.marble.uvPerMetre;
    const std::array<glm::vec2, 12> basin{{{0.0F, -0.1F},
                                           {3.0F, -0.1F},
                                           {3.0F, 0.12F},
                                           {2.75F, 0.14F},
                                           {2.70F, 0.22F},
                                           {2.78F, 0.62F},
                                           {2.90F, 0.68F},
                                           {2.90F, 0.78F},
                                           {2.86F, 0.82F},
                                           {2.48F, 0.82F},
                                           {2.44F, 0.34F},
                                           {0.0F, 0.34F}}};
    const std::array<glm::vec2, 21> bowl{
        {{0.0F, 0.30F},  {0.55F, 0.30F}, {0.55F, 0.50F}, {0.36F, 0.56F}, {0.26F, 0.70F},
         {0.24F, 1.10F}, {0.32F, 1.42F}, {0.22F, 1.52F}, {0.30F, 1.60F}, {0.80F, 1.74F},
         {1.12F, 1.94F}, {1.20F, 2.04F}, {1.16F, 2.07F}, {1.05F, 2.00F}, {0.60F, 1.86F},
         {0.20F, 1.84F}, {0.14F, 2.30F}, {0.22F, 2.44F}, {0.16F, 2.58F}, {0.06F, 2.66F},
         {0.0F, 2.67F}}};
    Mesh stone = lathe(basin, {.segments = 8 * 12, .uvPerMetre = uv, .crease = 0.5F});
    append(stone, lathe(bowl, {.segments = 48, .uvPerMetre = uv, .crease = 0.5F}));
    const auto pool = [&](float radius, float low, float high) {
        const std::array<glm::vec2, 4> profile{
            {{0.0F, low}, {radius, low}, {radius, high}, {0.0F, high}}};
        Mesh mesh = lathe(profile, {.segments = 48});
        for (Vertex& v : mesh.vertices)
            v.uv = planarUv(v.position, {0.0F, 1.0F, 0.0F}, m.water.uvPerMetre);
        return mesh;
    };
    Mesh water = pool(2.46F, 0.36F, 0.62F);
    append(water, pool(1.02F, 1.90F, 1.975F));
    Mesh spray;
    for (int i = 0; i < 12; ++i) {
        const float angle = 2.0F * pi * (static_cast<float>(i) + 0.5F) / 12.0F;
        append(spray, jet(onCircle(1.10F, angle, 2.03F), onCircle(1.75F, angle, 0.60F), 0.20F));
        if (i % 2 == 0)
            append(spray, jet(onCircle(0.05F, angle, 2.64F), onCircle(0.72F, angle, 1.96F), 0.55F));
    }
    const Index mesh = scene.add(
        MeshObject{.name = "fountain",
                   .primitives = {{.mesh = welded(stone), .material = m.marble.material},
                                  {.mesh = welded(water), .material = m.water.material},
                                  {.mesh = welded(spray), .material = m.spray.material}}});
    scene.add(Node{.name = "fountain", .translation = {-12.2F, 0.0F, -8.0F}, .mesh = mesh});
}

void addArmillary(Scene& scene, const Materials& m) {
    const float uv = m.marble.uvPerMetre;
    Mesh pedestal = box({-0.85F, -0.05F, -0.85F}, {0.85F, 0.20F, 0.85F}, uv, 0.03F);
    append(pedestal, box({-0.70F, 0.18F, -0.70F}, {0.70F, 0.38F, 0.70F}, uv, 0.03F));
    const std::array<glm::vec2, 14> stem{{{0.0F, 0.36F},
                                          {0.56F, 0.36F},
                                          {0.56F, 0.44F},
                                          {0.44F, 0.52F},
                                          {0.34F, 0.62F},
                                          {0.30F, 0.80F},
                                          {0.32F, 1.10F},
                                          {0.42F, 1.28F},
                                          {0.40F, 1.36F},
                                          {0.52F, 1.42F},
                                          {0.56F, 1.50F},
                                          {0.56F, 1.58F},
                                          {0.50F, 1.60F},
                                          {0.0F, 1.60F}}};
    append(pedestal, lathe(stem, {.segments = 48, .uvPerMetre = uv, .crease = 0.5F}));
    const float metal = m.bronze.uvPerMetre;
    const std::array<glm::vec2, 6> foot{{{0.0F, 1.58F},
                                         {0.34F, 1.58F},
                                         {0.30F, 1.66F},
                                         {0.09F, 1.74F},
                                         {0.07F, 1.98F},
                                         {0.0F, 1.99F}}};
    constexpr float middle = 3.25F;
    constexpr float radius = 1.25F;
    Mesh stand = lathe(foot, {.segments = 32, .uvPerMetre = metal});
    const glm::mat4 up = glm::translate(glm::mat4{1.0F}, glm::vec3{0.0F, middle, 0.0F});
    append(stand, hoop(radius, 0.12F, 0.05F, metal), up);  // the horizon
    const glm::mat4 meridian = glm::rotate(up, pi / 2, glm::vec3{0.0F, 0.0F, 1.0F});
    append(stand, hoop(radius + 0.02F, 0.09F, 0.06F, metal), meridian);
    const Index standMesh = scene.add(
        MeshObject{.name = "armillary stand",
                   .primitives = {{.mesh = welded(pedestal), .material = m.marble.material},
                                  {.mesh = welded(stand), .material = m.bronze.material}}});
    const Index stage =
        scene.add(Node{.name = "armillary",
                       .translation = {11.6F, 0.0F, -2.6F},
                       .rotation = lookingAlong(onCircle(1.0F, static_cast<float>(plazaNorth()))),
                       .mesh = standMesh});
    // The moving sphere's Y is the world's axis, which points to the celestial pole.
    const auto tilt = static_cast<float>(plazaTime().latitude) - pi / 2;
    const Index sky = scene.add(Node{.name = "armillary sky",
                                     .translation = {0.0F, middle, 0.0F},
                                     .rotation = glm::angleAxis(tilt, glm::vec3{1.0F, 0.0F, 0.0F})},
                                stage);
    Mesh rings = hoop(1.08F, 0.10F, 0.035F, metal);  // equator
    for (const float side : {-1.0F, 1.0F}) {         // tropics
        append(rings, hoop(0.99F, 0.06F, 0.03F, metal),
               glm::translate(glm::mat4{1.0F}, glm::vec3{0.0F, side * 0.43F, 0.0F}));
    }
    for (const float angle : {0.0F, pi / 2}) {  // circles through the poles
        append(rings, hoop(1.10F, 0.06F, 0.03F, metal),
               glm::rotate(glm::rotate(glm::mat4{1.0F}, angle, glm::vec3{0.0F, 1.0F, 0.0F}), pi / 2,
                           glm::vec3{0.0F, 0.0F, 1.0F}));
    }
    append(rings, tube(std::array{glm::vec3{0.0F, -1.32F, 0.0F}, glm::vec3{0.0F, 1.32F, 0.0F}},
                       std::array{0.022F, 0.022F}, 10, metal));
    const Index turning =
        scene.add(Node{.name = "armillary rings",
                       .mesh = scene.add("armillary rings", welded(rings), m.bronze.material)},
                  sky);
    addTurning(scene, turning, {0.0F, 1.0F, 0.0F}, 1);
    Mesh ecliptic = hoop(0.90F, 0.18F, 0.02F, 1.0F);
    append(ecliptic, sphere(0.06F, 12, 8, 1.0F),
           glm::translate(glm::mat4{1.0F}, glm::vec3{0.91F, 0.0F, 0.0F}));
    const Index band =
        scene.add(Node{.name = "ecliptic",
                       .rotation = glm::angleAxis(0.41F, glm::vec3{0.0F, 0.0F, 1.0F}),
                       .mesh = scene.add("ecliptic", welded(ecliptic), m.gold.material)},
                  sky);
    addTurning(scene, band, {0.0F, 1.0F, 0.0F}, -2);
    const Index planet =
        scene.add(Node{.name = "earth",
                       .mesh = scene.add("earth", sphere(0.24F, 32, 20, metal), m.gold.material)},
                  sky);
    addTurning(scene, planet, {0.0F, 1.0F, 0.0F}, 4);
}

}  // namespace gnomon::demo
