#include <gnomon/demo/Random.h>
#include <gnomon/demo/Scenes.h>
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float halfSide = 120.0F;  // metres

/// 40 x 40 squares of 6 m.
Mesh ground() {
    Mesh mesh;
    addGrid(mesh, 40, 40, false, [](int row, int column) {
        const glm::vec3 p{-halfSide + 6.0F * static_cast<float>(column), 0.0F,
                          halfSide - 6.0F * static_cast<float>(row)};
        return Vertex{p, {}, {p.x / 6.0F, p.z / 6.0F}};
    });
    return shaded(mesh);
}

/// A free spot: uniform over the square, @p away or more from the fence along X.
glm::vec3 spot(Random& random, float reach, float away) {
    glm::vec3 at{0.0F};
    do {
        at = {random.between(-reach, reach), 0.0F, random.between(-reach, reach)};
    } while (std::abs(at.x) < 22.0F && std::abs(at.z - 6.0F) < away);
    return at;
}

/// A leaf is a triangle seen from both sides: two triangles, back to back.
void addLeaf(Mesh& mesh, Random& random, const glm::vec3& at) {
    std::array<Vertex, 3> corners;
    const float size = random.between(0.10F, 0.24F);
    for (Vertex& v : corners) {
        v.position = at + size * glm::vec3{random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F),
                                           random.between(-1.0F, 1.0F)};
    }
    addTriangle(mesh, corners[0], corners[1], corners[2]);
    addTriangle(mesh, corners[0], corners[2], corners[1]);
}

}  // namespace

Scene grove(std::uint64_t seed) {
    Scene scene{.name = "grove"};
    Random random{seed, 71};
    const Index material = scene.add(Material{.name = "matter"});
    const auto put = [&](const char* name, Mesh mesh, bool closed) {
        const Index index = scene.add(MeshObject{
            .name = name,
            .primitives = {{.mesh = std::move(mesh), .material = material, .closed = closed}}});
        scene.add(Node{.name = name, .mesh = index});
    };
    put("ground", ground(), false);
    for (int i = 0; i < 60; ++i) {
        const glm::vec3 at = spot(random, 110.0F, 3.0F);
        const float half = random.between(0.25F, 0.36F);
        put("pillar", box(at - glm::vec3{half, 0.0F, half}, at + glm::vec3{half, 4.0F, half}, 1.0F),
            true);
    }
    for (int i = 0; i < 40; ++i) {
        const float radius = random.between(0.35F, 1.1F);
        const glm::vec3 at =
            spot(random, 105.0F, 4.0F) + glm::vec3{0.0F, radius + random.between(0.0F, 2.0F), 0.0F};
        Mesh ball;
        append(ball, sphere(radius, 32, 16, 1.0F), glm::translate(glm::mat4{1.0F}, at));
        put("sphere", std::move(ball), true);
    }
    // The fence: 80 slats of 6 cm every half metre, and two rails.
    const float skew = random.between(-0.1F, 0.1F);
    const auto fenceZ = [&](float x) { return 6.0F + skew * x; };
    Mesh fence;
    for (int i = 0; i < 80; ++i) {
        const float x = -19.75F + 0.5F * static_cast<float>(i);
        append(fence, box({x - 0.03F, 0.0F, fenceZ(x) - 0.015F},
                          {x + 0.03F, 1.2F, fenceZ(x) + 0.015F}, 1.0F));
    }
    const float length = 40.0F * std::sqrt(1.0F + skew * skew);
    for (const float y : {0.35F, 0.95F}) {
        const glm::mat4 along =
            glm::rotate(glm::translate(glm::mat4{1.0F}, glm::vec3{0.0F, y, 6.0F}), -std::atan(skew),
                        glm::vec3{0.0F, 1.0F, 0.0F});
        append(fence, box({-length / 2, 0.0F, -0.012F}, {length / 2, 0.06F, 0.012F}, 1.0F), along);
    }
    put("fence", std::move(fence), true);
    Mesh foliage;
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 at = spot(random, 108.0F, 6.0F);
        const float height = random.between(2.0F, 5.8F);
        const float half = random.between(0.12F, 0.19F);
        put("trunk",
            box(at - glm::vec3{half, 0.0F, half}, at + glm::vec3{half, height, half}, 1.0F), true);
        const float crown = random.between(1.3F, 2.2F);
        for (int leaf = 0; leaf < 700; ++leaf) {
            const float y = random.between(-1.0F, 1.0F);
            const float angle = random.between(0.0F, 2.0F * pi);
            const float radius = crown * std::cbrt(random.unit());
            const float flat = std::sqrt(1.0F - y * y);
            addLeaf(foliage, random,
                    at + glm::vec3{radius * flat * std::cos(angle), height + radius * y,
                                   radius * flat * std::sin(angle)});
        }
    }
    put("leaves", shaded(foliage, 0.1F), false);
    return scene;
}

}  // namespace gnomon::demo
