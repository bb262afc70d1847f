// Paving, the low wall round the open side, hills and houses beyond.
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "../Noise.h"
#include "../Paint.h"
#include "Parts.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A flat ring on the ground, in steps, with its texture laid on in metres. Open.
Mesh flatRing(float inner, float outer, int rings, int segments, float uvPerMetre,
              const std::function<float(float, float)>& height) {
    Mesh mesh;
    addGrid(mesh, rings, segments, true, [&](int row, int column) {
        // Seen from above, right and up: columns run clockwise, rows outward.
        const float part = static_cast<float>(row) / static_cast<float>(rings);
        const float radius = outer + (inner - outer) * part;
        const float angle = -2.0F * pi * static_cast<float>(column) / static_cast<float>(segments);
        glm::vec3 p = onCircle(radius, angle);
        p.y = height(p.x, p.z);
        return Vertex{p, {}, planarUv(p, {0.0F, 1.0F, 0.0F}, uvPerMetre)};
    });
    // The seam keeps its own texture coordinates: they are a function of place.
    for (Vertex& v : mesh.vertices) v.uv = planarUv(v.position, {0.0F, 1.0F, 0.0F}, uvPerMetre);
    return shaded(mesh, 1.2F);
}

}  // namespace

float terrainHeight(float x, float z, std::uint64_t seed) {
    const Noise noise{seed * 41 + 7};
    const float radius = std::sqrt(x * x + z * z);
    const float hills = noise.fractal(x / 256.0F + 0.5F, z / 256.0F + 0.5F, 5, 4);
    const float rise = ramp(34.0F, 92.0F, radius);
    return -0.06F + rise * (8.5F + 9.0F * hills);
}

void addGround(Scene& scene, const Materials& m, std::uint64_t seed) {
    const auto open = [&](const char* name, Mesh mesh, const Finish& finish) {
        const Index index = scene.add(MeshObject{
            .name = name,
            .primitives = {
                {.mesh = std::move(mesh), .material = finish.material, .closed = false}}});
        scene.add(Node{.name = name, .mesh = index});
    };
    const auto flat = [](float, float) { return 0.0F; };
    open("paving", flatRing(0.0F, site::plazaRadius, 8, 72, m.paving.uvPerMetre, flat), m.paving);
    open("hills",
         flatRing(30.0F, 100.0F, 26, 96, m.grass.uvPerMetre,
                  [&](float x, float z) { return terrainHeight(x, z, seed); }),
         m.grass);

    const float uv = m.travertine.uvPerMetre;
    Mesh bands;
    for (int i = 0; i < 24; ++i) {  // strips between the steps of the dial and of the wings
        append(bands, box({-0.22F, -0.05F, -22.35F}, {0.22F, 0.010F, -10.4F}, uv),
               turned(2.0F * pi * static_cast<float>(i) / 24.0F));
    }
    const auto ring = [&](float inner, float outer, float top) {
        const std::array<glm::vec2, 5> profile{
            {{inner, -0.05F}, {outer, -0.05F}, {outer, top}, {inner, top}, {inner, -0.05F}}};
        return lathe(profile, {.segments = 120, .uvPerMetre = uv});
    };
    append(bands, ring(12.9F, 13.4F, 0.014F));
    append(bands, ring(17.6F, 18.1F, 0.014F));
    append(bands, ring(21.8F, 22.5F, 0.014F));
    // The low wall, with a way in behind the viewer.
    const LatheOptions options{.segments = 40, .uvPerMetre = uv, .crease = 0.3F};
    const std::array<glm::vec2, 4> wall{
        {{29.5F, -0.1F}, {30.0F, -0.1F}, {30.0F, 0.72F}, {29.5F, 0.72F}}};
    const std::array<glm::vec2, 6> cap{{{29.40F, 0.70F},
                                        {30.10F, 0.70F},
                                        {30.10F, 0.80F},
                                        {30.06F, 0.84F},
                                        {29.44F, 0.84F},
                                        {29.40F, 0.80F}}};
    for (const auto& [from, to] : {std::pair{1.62F, 2.92F}, std::pair{3.36F, 4.50F}}) {
        append(bands, arc(wall, from, to, options));
        append(bands, arc(cap, from - 0.003F, to + 0.003F, options));
    }
    scene.add(
        Node{.name = "bands", .mesh = scene.add("bands", welded(bands), m.travertine.material)});
}

void addHouses(Scene& scene, const Materials& m, std::uint64_t seed) {
    struct Place {
        float angle = 0.0F;
        float radius = 0.0F;
    };
    static constexpr std::array<Place, 11> places{{{-0.86F, 70.0F},
                                                   {-0.74F, 76.0F},
                                                   {-0.52F, 66.0F},
                                                   {-0.38F, 78.0F},
                                                   {-0.22F, 71.0F},
                                                   {-0.06F, 82.0F},
                                                   {0.13F, 74.0F},
                                                   {0.24F, 66.0F},
                                                   {0.42F, 76.0F},
                                                   {0.62F, 70.0F},
                                                   {0.85F, 78.0F}}};
    Random random{seed, 31};
    Mesh walls;
    Mesh roofs;
    Mesh shutters;
    for (const Place& place : places) {
        const glm::vec3 at = onCircle(place.radius, place.angle);
        const float half = random.between(2.6F, 4.4F);
        const float depth = random.between(2.4F, 3.4F);
        const float height = random.between(3.4F, 6.2F);
        const float turn = place.angle + random.between(-0.5F, 0.5F);
        const glm::mat4 frame =
            glm::translate(glm::mat4{1.0F},
                           glm::vec3{at.x, terrainHeight(at.x, at.z, seed) - 1.0F, at.z}) *
            turned(turn);
        // The gables stand left and right of the front: the prism runs along X.
        const glm::mat4 along = glm::rotate(frame, pi / 2, glm::vec3{0.0F, 1.0F, 0.0F});
        const float ridge = height + 1.0F + 0.42F * depth;
        const std::array<glm::vec2, 5> gable{glm::vec2{-depth, 0.0F},
                                             {depth, 0.0F},
                                             {depth, height + 1.0F},
                                             {0.0F, ridge},
                                             {-depth, height + 1.0F}};
        append(walls, prism(gable, -half, half, m.plaster.uvPerMetre), along);
        for (const float side : {-1.0F, 1.0F}) {
            const float eave = depth + 0.35F;
            const float low = height + 1.0F - 0.42F * 0.35F + 0.02F;
            std::vector<glm::vec2> slope{{side * eave, low},
                                         {side * eave, low + 0.16F},
                                         {-side * 0.02F, ridge + 0.18F},
                                         {-side * 0.02F, ridge + 0.02F}};
            if (side < 0.0F) std::reverse(slope.begin(), slope.end());
            append(roofs, prism(slope, -half - 0.3F, half + 0.3F, m.roof.uvPerMetre), along);
        }
        const int windows = half > 3.4F ? 3 : 2;
        for (int storey = 0; storey < (height > 4.8F ? 2 : 1); ++storey) {
            for (int i = 0; i < windows; ++i) {
                const float x =
                    half *
                    ((static_cast<float>(i) + 0.5F) / static_cast<float>(windows) * 2.0F - 1.0F);
                const float y = height + 1.0F - 2.1F - 2.4F * static_cast<float>(storey);
                append(
                    shutters,
                    box({x - 0.45F, y, depth - 0.05F}, {x + 0.45F, y + 1.4F, depth + 0.06F}, 1.0F),
                    frame);
            }
        }
    }
    // Roof tiles run down the slope: the prism's sides carry the slope in u.
    for (Vertex& v : roofs.vertices) v.uv = {v.uv.y, v.uv.x};
    const auto put = [&](const char* name, const Mesh& mesh, const Finish& finish) {
        scene.add(Node{.name = name, .mesh = scene.add(name, welded(mesh), finish.material)});
    };
    put("house walls", walls, m.plaster);
    put("house roofs", roofs, m.roof);
    put("house shutters", shutters, m.wood);
}

}  // namespace gnomon::demo
