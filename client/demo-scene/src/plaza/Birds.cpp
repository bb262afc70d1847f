// Gulls that circle over the square: one node turns, the bird hangs on it and beats its wings.
#include <gnomon/demo/Shapes.h>

#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {
namespace {

/// Looks along -Z; half a metre long.
Mesh body() {
    const std::array<glm::vec2, 10> profile{{{0.0F, -0.28F},
                                             {0.05F, -0.24F},
                                             {0.03F, -0.16F},
                                             {0.075F, -0.02F},
                                             {0.085F, 0.08F},
                                             {0.06F, 0.17F},
                                             {0.055F, 0.21F},
                                             {0.045F, 0.25F},
                                             {0.012F, 0.28F},
                                             {0.0F, 0.33F}}};
    Mesh mesh;
    append(
        mesh, lathe(profile, {.segments = 12, .crease = 1.3F}),
        glm::rotate(glm::mat4{1.0F}, -std::numbers::pi_v<float> / 2, glm::vec3{1.0F, 0.0F, 0.0F}));
    return mesh;
}

/// From the shoulder at the origin to the right.
Mesh wing() {
    const std::array<glm::vec2, 6> outline{{{0.0F, -0.09F},
                                            {0.28F, -0.10F},
                                            {0.68F, -0.02F},
                                            {0.66F, 0.0F},
                                            {0.30F, 0.09F},
                                            {0.0F, 0.09F}}};
    Mesh mesh;
    append(
        mesh, prism(outline, -0.009F, 0.009F, 1.0F),
        glm::rotate(glm::mat4{1.0F}, -std::numbers::pi_v<float> / 2, glm::vec3{1.0F, 0.0F, 0.0F}));
    return mesh;
}

}  // namespace

void addBirds(Scene& scene, const Materials& m, std::uint64_t seed) {
    Random random{seed, 61};
    const Index bodyMesh = scene.add("gull", body(), m.gull.material);
    const Index rightMesh = scene.add("gull right wing", wing(), m.gull.material);
    Mesh left;
    append(left, wing(), glm::scale(glm::mat4{1.0F}, glm::vec3{-1.0F, 1.0F, 1.0F}));
    const Index leftMesh = scene.add("gull left wing", left, m.gull.material);
    constexpr int birds = 6;
    for (int i = 0; i < birds; ++i) {
        const float start = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / birds;
        const float radius = random.between(5.0F, 9.5F);
        const float height = random.between(9.5F, 13.0F);
        const Index circle =
            scene.add(Node{.name = "gull circle",
                           .translation = {random.between(-3.0F, 3.0F), height, -9.0F},
                           .rotation = glm::angleAxis(start, glm::vec3{0.0F, 1.0F, 0.0F})});
        addTurning(scene, circle, {0.0F, 1.0F, 0.0F}, i % 3 == 0 ? 2 : 1);
        // Counter-clockwise from above: at +X the way ahead is -Z. It leans into the turn.
        const Index bird =
            scene.add(Node{.name = "gull",
                           .translation = {radius, 0.0F, 0.0F},
                           .rotation = glm::angleAxis(0.3F, glm::vec3{0.0F, 0.0F, 1.0F}),
                           .scale = glm::vec3{1.25F},
                           .mesh = bodyMesh},
                      circle);
        for (const float side : {-1.0F, 1.0F}) {
            const Index wingNode = scene.add(
                Node{.name = "gull wing",
                     .translation = {side * 0.05F, 0.02F, -0.03F},
                     .rotation = glm::angleAxis(side * 0.15F, glm::vec3{0.0F, 0.0F, 1.0F}),
                     .mesh = side > 0.0F ? rightMesh : leftMesh},
                bird);
            addSwinging(scene, wingNode, {0.0F, 0.0F, side}, 0.45F, 36,
                        static_cast<float>(i) * 0.17F);
        }
    }
}

}  // namespace gnomon::demo
