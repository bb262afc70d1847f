// Trees: trunks are closed tubes, foliage is cards cut out by alpha.
#include <gnomon/demo/Shapes.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

glm::vec3 onSphere(Random& random) {
    const float y = random.between(-1.0F, 1.0F);
    const float angle = random.between(0.0F, 2.0F * pi);
    const float radius = std::sqrt(1.0F - y * y);
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

struct Card {
    glm::vec3 middle{0.0F};
    glm::vec3 facing{0.0F, 0.0F, 1.0F};  ///< unit; the side that is wound counter-clockwise
    glm::vec3 up{0.0F, 1.0F, 0.0F};      ///< as far as it is perpendicular to facing
    glm::vec2 size{1.0F};
    bool mirrored = false;
};

/// Adds a card whose corners have the normals of a round crown about @p centre: flat normals
/// would show each card as a flat thing.
void addCard(Mesh& mesh, const Card& card, const glm::vec3& centre) {
    const glm::vec3 right = glm::normalize(glm::cross(card.up, card.facing));
    const glm::vec3 up = glm::cross(card.facing, right);
    const auto corner = [&](float x, float y) {
        const glm::vec3 p =
            card.middle + right * (x * card.size.x / 2) + up * (y * card.size.y / 2);
        glm::vec3 normal = glm::normalize(p - centre);
        // Renderers turn the normal of a back face round, so it must agree with the winding.
        const float along = glm::dot(normal, card.facing);
        if (along < 0.1F) normal = glm::normalize(normal + (0.1F - along) * card.facing);
        const float u = card.mirrored ? 0.5F - x / 2 : 0.5F + x / 2;
        return Vertex{p, normal, {u, 0.5F - y / 2}};
    };
    addQuad(mesh, corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
}

struct Tree {
    Mesh wood = {};
    Mesh foliage = {};
    Mesh core = {};
};

/// About 7 m high with a crown 5 m across.
Tree broadLeaf(Random random, float uv) {
    Tree tree;
    const glm::vec3 crown{0.0F, 4.7F, 0.0F};
    const glm::vec3 fork{random.between(-0.2F, 0.2F), 2.3F, random.between(-0.2F, 0.2F)};
    const std::array<glm::vec3, 5> trunk{glm::vec3{0.0F, -0.3F, 0.0F},
                                         {0.0F, 0.15F, 0.0F},
                                         fork * 0.5F + glm::vec3{0.12F, 0.0F, -0.06F},
                                         fork,
                                         fork + glm::vec3{0.05F, 0.9F, 0.05F}};
    tree.wood = tube(trunk, std::array{0.40F, 0.28F, 0.21F, 0.19F, 0.12F}, 12, uv);
    struct Blob {
        glm::vec3 middle{0.0F};
        float radius = 1.0F;
    };
    std::vector<Blob> blobs{{crown + glm::vec3{0.0F, 0.9F, 0.0F}, 1.6F}};
    constexpr int branches = 7;
    for (int i = 0; i < branches; ++i) {
        const float angle =
            2.0F * pi * (static_cast<float>(i) + random.between(-0.25F, 0.25F)) / branches;
        const float out = random.between(1.5F, 2.2F);
        const glm::vec3 end = onCircle(out, angle, crown.y + random.between(-0.7F, 0.7F));
        const glm::vec3 middle = glm::mix(fork, end, 0.5F) + glm::vec3{0.0F, -0.25F, 0.0F};
        const glm::vec3 root = fork + glm::vec3{0.0F, random.between(-0.3F, 0.4F), 0.0F};
        append(tree.wood,
               tube(std::array{root, middle, end}, std::array{0.11F, 0.075F, 0.02F}, 7, uv));
        blobs.push_back({end, random.between(0.9F, 1.25F)});
    }
    constexpr int cards = 440;
    for (int i = 0; i < cards; ++i) {
        const Blob& blob = blobs[static_cast<std::size_t>(i) % blobs.size()];
        const glm::vec3 out = onSphere(random);
        const glm::vec3 middle = blob.middle + out * blob.radius *
                                                   std::sqrt(random.between(0.25F, 1.0F)) *
                                                   glm::vec3{1.0F, 0.8F, 1.0F};
        const glm::vec3 facing =
            glm::normalize(glm::normalize(middle - crown) + 0.9F * onSphere(random));
        const float size = random.between(0.7F, 1.05F);
        addCard(tree.foliage,
                {.middle = middle,
                 .facing = facing,
                 .up = glm::normalize(glm::vec3{0.0F, 1.0F, 0.0F} + 0.7F * onSphere(random)),
                 .size = glm::vec2{size},
                 .mirrored = i % 2 == 0},
                crown - glm::vec3{0.0F, 0.8F, 0.0F});
    }
    return tree;
}

/// A ball of leaves on a stem, for the planters: 2.4 m over its root.
Tree standard(Random random, float uv) {
    Tree tree;
    tree.wood = tube(std::array{glm::vec3{0.0F, -0.1F, 0.0F}, glm::vec3{0.03F, 0.7F, 0.02F},
                                glm::vec3{0.0F, 1.7F, 0.0F}},
                     std::array{0.06F, 0.05F, 0.03F}, 8, uv);
    const glm::vec3 crown{0.0F, 1.75F, 0.0F};
    for (int i = 0; i < 150; ++i) {
        const glm::vec3 out = onSphere(random);
        const glm::vec3 facing = glm::normalize(out + 0.7F * onSphere(random));
        const float size = random.between(0.36F, 0.5F);
        addCard(tree.foliage,
                {.middle = crown + out * random.between(0.35F, 0.68F),
                 .facing = facing,
                 .up = glm::normalize(glm::vec3{0.0F, 1.0F, 0.0F} + 0.6F * onSphere(random)),
                 .size = glm::vec2{size},
                 .mirrored = i % 2 == 0},
                crown - glm::vec3{0.0F, 0.2F, 0.0F});
    }
    return tree;
}

/// Radius of a cypress at height @p y of its 10 metres.
float cypressRadius(float y) {
    const float t = std::clamp(y / 10.0F, 0.0F, 1.0F);
    return 1.02F * std::pow(t + 0.02F, 0.28F) * std::pow(1.0F - t, 0.62F);
}

Tree cypress(Random random, float uv) {
    Tree tree;
    tree.wood = tube(std::array{glm::vec3{0.0F, -0.4F, 0.0F}, glm::vec3{0.0F, 0.9F, 0.0F}},
                     std::array{0.22F, 0.16F}, 10, uv);
    std::vector<glm::vec2> profile{{0.0F, 0.35F}};
    for (int i = 1; i < 12; ++i) {
        const float y = 0.35F + 8.9F * static_cast<float>(i) / 12.0F;
        profile.emplace_back(0.70F * cypressRadius(y), y);
    }
    profile.emplace_back(0.0F, 9.25F);
    tree.core = lathe(profile, {.segments = 12, .crease = 1.2F});
    constexpr int cards = 330;
    for (int i = 0; i < cards; ++i) {
        const float t = (static_cast<float>(i) + random.unit()) / cards;
        const float y = 0.75F + 8.9F * t;
        const float angle = random.between(0.0F, 2.0F * pi);
        const float radius = cypressRadius(y);
        const glm::vec3 out = onCircle(1.0F, angle);
        const glm::vec3 facing =
            glm::normalize(out + 0.5F * onSphere(random) * glm::vec3{1.0F, 0.3F, 1.0F});
        const glm::vec2 size{random.between(0.62F, 0.85F) * (0.55F + 0.45F * radius),
                             random.between(1.1F, 1.6F) * (0.7F + 0.3F * radius)};
        addCard(tree.foliage,
                {.middle = onCircle(radius * random.between(0.70F, 0.88F), angle, y),
                 .facing = facing,
                 .up = glm::normalize(glm::vec3{0.0F, 1.0F, 0.0F} + 0.16F * out +
                                      0.12F * onSphere(random)),
                 .size = size,
                 .mirrored = i % 2 == 0},
                {0.0F, y - 0.35F, 0.0F});
    }
    return tree;
}

/// Bare earth with a kerb, where a tree grows out of the paving.
void addTreePit(Scene& scene, const Materials& m, const glm::vec3& at) {
    const std::array<glm::vec2, 4> earth{
        {{0.0F, -0.1F}, {1.05F, -0.1F}, {1.05F, 0.05F}, {0.0F, 0.10F}}};
    const std::array<glm::vec2, 7> kerb{{{1.0F, -0.1F},
                                         {1.25F, -0.1F},
                                         {1.25F, 0.14F},
                                         {1.22F, 0.17F},
                                         {1.03F, 0.17F},
                                         {1.0F, 0.14F},
                                         {1.0F, -0.1F}}};
    const Index mesh = scene.add(MeshObject{
        .name = "tree pit",
        .primitives = {
            {.mesh = lathe(earth, {.segments = 32}), .material = m.soil.material},
            {.mesh = lathe(kerb,
                           {.segments = 40, .uvPerMetre = m.travertine.uvPerMetre, .crease = 0.4F}),
             .material = m.travertine.material}}});
    scene.add(Node{.name = "tree pit", .translation = at, .mesh = mesh});
}

Index addTree(Scene& scene, const Materials& m, const char* name, const Tree& tree,
              const Finish& foliage) {
    MeshObject object{
        .name = name,
        .primitives = {{.mesh = welded(tree.wood), .material = m.bark.material},
                       {.mesh = tree.foliage, .material = foliage.material, .closed = false}}};
    if (!tree.core.indices.empty())
        object.primitives.push_back({.mesh = tree.core, .material = m.core.material});
    return scene.add(std::move(object));
}

}  // namespace

void addTrees(Scene& scene, const Materials& m, std::uint64_t seed) {
    Random random{seed, 51};
    const float uv = m.bark.uvPerMetre;
    const std::array broad{
        addTree(scene, m, "plane tree A", broadLeaf(Random{seed, 52}, uv), m.leaves),
        addTree(scene, m, "plane tree B", broadLeaf(Random{seed, 53}, uv), m.leaves)};
    const std::array slim{addTree(scene, m, "cypress A", cypress(Random{seed, 54}, uv), m.needles),
                          addTree(scene, m, "cypress B", cypress(Random{seed, 55}, uv), m.needles)};
    const Index potted = addTree(scene, m, "lemon tree", standard(Random{seed, 56}, uv), m.leaves);
    int count = 0;
    const auto put = [&](const std::array<Index, 2>& kinds, const glm::vec3& at, float scale) {
        const float y =
            at.y + (glm::length(at) > site::plazaRadius ? terrainHeight(at.x, at.z, seed) : 0.0F);
        const float turn = random.between(0.0F, 2.0F * pi);
        const float size = scale * random.between(0.93F, 1.07F);
        const Index kind = kinds[static_cast<std::size_t>(count++ % 2)];
        scene.add(Node{.name = scene.meshes[kind].name,
                       .translation = {at.x, y, at.z},
                       .rotation = glm::angleAxis(turn, glm::vec3{0.0F, 1.0F, 0.0F}),
                       .scale = glm::vec3{size},
                       .mesh = kind});
    };
    // Left of the viewer, out of the picture: their shadows cross the foreground.
    for (const glm::vec3& at : {glm::vec3{-15.6F, 0.0F, 15.6F}, glm::vec3{-20.0F, 0.0F, 18.6F},
                                glm::vec3{19.5F, 0.0F, 15.0F}}) {
        put(broad, at, 1.1F);
        addTreePit(scene, m, at);
    }
    for (const float angle : {-0.98F, -0.60F, 0.55F, 0.80F, 1.05F, 1.32F, 1.60F})
        put(broad, onCircle(35.0F + 2.0F * random.unit(), angle), 1.45F);
    for (const float angle :
         {-0.90F, -0.80F, -0.71F, -0.47F, -0.36F, 0.34F, 0.44F, 0.66F, 0.92F, 1.18F}) {
        put(slim, onCircle(31.5F + 2.5F * random.unit(), angle), random.between(1.0F, 1.25F));
    }
    for (int i = 0; i < 16; ++i) {  // on the hills
        put(slim,
            onCircle(random.between(48.0F, 84.0F),
                     -1.0F + 2.1F * (static_cast<float>(i) + random.unit()) / 16.0F),
            random.between(0.8F, 1.2F));
    }
    for (const float angle : {-0.40F, 0.40F, 0.72F, 1.0F, 1.26F})
        put({potted, potted}, onCircle(20.6F, angle, 0.84F), 1.15F);
}

}  // namespace gnomon::demo
