// Benches, groups of jars, planters.
#include <gnomon/demo/Shapes.h>

#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {
namespace {

Mesh bench(float uv) {
    Mesh mesh = box({-1.15F, 0.44F, -0.27F}, {1.15F, 0.55F, 0.27F}, uv, 0.025F);
    const std::array<glm::vec2, 10> profile{{{-0.22F, -0.02F},
                                             {0.22F, -0.02F},
                                             {0.22F, 0.07F},
                                             {0.15F, 0.12F},
                                             {0.11F, 0.24F},
                                             {0.20F, 0.45F},
                                             {-0.20F, 0.45F},
                                             {-0.11F, 0.24F},
                                             {-0.15F, 0.12F},
                                             {-0.22F, 0.07F}}};
    const Mesh foot = prism(profile, -0.09F, 0.09F, uv);
    for (const float x : {-0.8F, 0.8F}) {
        append(mesh, foot,
               glm::rotate(glm::translate(glm::mat4{1.0F}, glm::vec3{x, 0.0F, 0.0F}),
                           std::numbers::pi_v<float> / 2, glm::vec3{0.0F, 1.0F, 0.0F}));
    }
    return welded(mesh);
}

/// A round pot with a rim; its soil is a mesh of its own.
Mesh planter(float uv) {
    const std::array<glm::vec2, 13> profile{{{0.0F, 0.0F},
                                             {0.50F, 0.0F},
                                             {0.52F, 0.06F},
                                             {0.48F, 0.10F},
                                             {0.62F, 0.55F},
                                             {0.66F, 0.60F},
                                             {0.66F, 0.66F},
                                             {0.70F, 0.70F},
                                             {0.70F, 0.80F},
                                             {0.66F, 0.84F},
                                             {0.58F, 0.84F},
                                             {0.55F, 0.60F},
                                             {0.0F, 0.60F}}};
    return lathe(profile, {.segments = 40, .uvPerMetre = uv, .crease = 0.5F});
}

}  // namespace

void addFurniture(Scene& scene, const Materials& m, std::uint64_t seed) {
    Random random{seed, 41};
    const auto put = [&](const char* name, Index mesh, const glm::vec3& at, const glm::vec3& facing,
                         float scale) {
        scene.add(Node{.name = name,
                       .translation = at,
                       .rotation = lookingAlong(facing),
                       .scale = glm::vec3{scale},
                       .mesh = mesh});
    };
    const Index benchMesh =
        scene.add("bench", bench(m.travertine.uvPerMetre), m.travertine.material);
    for (const glm::vec3& at : {glm::vec3{-5.7F, 0.0F, 10.5F},
                                {15.4F, 0.0F, 2.2F},
                                {16.1F, 0.0F, -7.6F},
                                {-16.2F, 0.0F, 1.5F},
                                {-6.2F, 0.0F, -18.6F},
                                {6.2F, 0.0F, -18.6F}}) {
        put("bench", benchMesh, at, at, 1.0F);
    }
    const Index jar =
        scene.add("amphora", amphora(1.0F, m.terracotta.uvPerMetre), m.terracotta.material);
    struct Jar {
        glm::vec3 at{0.0F};
        float size = 1.0F;
    };
    for (const Jar& j :
         {Jar{{5.3F, 0.0F, 10.9F}, 1.30F}, Jar{{4.5F, 0.0F, 11.3F}, 1.0F},
          Jar{{5.55F, 0.0F, 11.75F}, 0.82F}, Jar{{17.2F, 0.0F, -12.6F}, 1.2F},
          Jar{{18.0F, 0.0F, -11.9F}, 0.95F}, Jar{{9.2F, site::stylobate, -22.9F}, 1.15F},
          Jar{{-9.0F, site::stylobate, -22.9F}, 1.15F}}) {
        const float angle = random.between(0.0F, 6.28F);
        put("amphora", jar, j.at, onCircle(1.0F, angle), j.size * random.between(0.96F, 1.04F));
    }
    const std::array<glm::vec2, 4> soil{
        {{0.0F, 0.55F}, {0.565F, 0.55F}, {0.57F, 0.72F}, {0.0F, 0.76F}}};
    const Index pot = scene.add(MeshObject{
        .name = "planter",
        .primitives = {
            {.mesh = planter(m.terracotta.uvPerMetre), .material = m.terracotta.material},
            {.mesh = lathe(soil, {.segments = 40}), .material = m.soil.material}}});
    for (const float angle : {-0.40F, 0.40F, 0.72F, 1.0F, 1.26F})
        put("planter", pot, onCircle(20.6F, angle), {0.0F, 0.0F, -1.0F}, 1.15F);
}

}  // namespace gnomon::demo
