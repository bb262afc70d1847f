#include <gnomon/demo/Shapes.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>
#include <numeric>
#include <string>

#include "Topology.h"

namespace gnomon::demo {
namespace {

constexpr double pi = std::numbers::pi;

double volume(const Mesh& mesh) {
    const Topology t = examined(mesh);
    return std::accumulate(t.volumes.begin(), t.volumes.end(), 0.0);
}

struct Solid {
    const char* name = "";
    Mesh (*make)() = nullptr;
    double volume = 0.0;     ///< cubic metres
    double tolerance = 0.0;  ///< what the facets take away
};

/// A square of side 4 with a square hole of side 2, reached by a slit.
constexpr std::array<glm::vec2, 10> frame{glm::vec2{-2, -2}, {0, -2}, {0, -1}, {-1, -1},
                                          {-1, 1},           {1, 1},  {1, -1}, {0, -1},
                                          {0, -2},           {2, -2}};

Mesh framePrism() {
    std::vector<glm::vec2> outline{frame.begin(), frame.end()};
    outline.insert(outline.end(), {{2, 2}, {-2, 2}});
    return prism(outline, 0.0F, 0.5F, 1.0F);
}

const std::array<Solid, 9> solids{{
    {"box",
     [] {
         return box({-1, 0, -2}, {1, 3, 2}, 1.0F);
     },
     24.0, 1e-5},
    {"bevelledBox",
     [] {
         return box({0, 0, 0}, {1, 1, 1}, 1.0F, 0.1F);
     },
     1.0 - 12 * 0.005 * 0.8 - 8 * (0.001 * 5.0 / 6.0), 1e-5},
    {"prismWithHole", framePrism, 6.0, 1e-5},
    {"cylinder",
     [] {
         return lathe(std::array<glm::vec2, 4>{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}}, {.segments = 96});
     },
     2 * pi, 0.01},
    {"sphere", [] { return sphere(1.0F, 96, 64, 1.0F); }, 4.0 / 3.0 * pi, 0.01},
    {"torus", [] { return torus(2.0F, 0.5F, 96, 48, 1.0F); }, 2 * pi* pi * 2.0 * 0.25, 0.06},
    {"tube",
     [] {
         return tube(std::array{glm::vec3{0, 0, 0}, glm::vec3{0, 0, 3}, glm::vec3{0, 0, 5}},
                     std::array{0.5F, 0.5F, 0.5F}, 96, 1.0F);
     },
     1.25 * pi, 0.01},
    {"arc",
     [] {
         return arc(std::array<glm::vec2, 4>{{{1, 0}, {2, 0}, {2, 1}, {1, 1}}}, -0.5F, 1.5F,
                    {.segments = 64});
     },
     3.0, 0.01},
    {"mirrored",
     [] {
         Mesh mesh;
         append(mesh, sphere(1.0F, 32, 16, 1.0F), glm::scale(glm::mat4{1.0F}, glm::vec3{-1, 1, 1}));
         return mesh;
     },
     4.0 / 3.0 * pi, 0.15},
}};

class EverySolid : public testing::TestWithParam<Solid> {};

TEST_P(EverySolid, IsWatertightAndHasItsVolume) {
    const Mesh mesh = GetParam().make();
    const Topology t = examined(mesh);
    EXPECT_EQ(t.unmatchedEdges, 0U);
    EXPECT_EQ(t.flatTriangles, 0U);
    EXPECT_EQ(t.contraryNormals, 0U);
    EXPECT_EQ(t.volumes.size(), 1U);
    EXPECT_NEAR(volume(mesh), GetParam().volume, GetParam().tolerance);
}

INSTANTIATE_TEST_SUITE_P(All, EverySolid, testing::ValuesIn(solids),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Topology, SeesAHole) {
    Mesh mesh = sphere(1.0F, 16, 8, 1.0F);
    mesh.indices.resize(mesh.indices.size() - 3);
    EXPECT_EQ(examined(mesh).unmatchedEdges, 3U);
}

TEST(Topology, SeesASolidTurnedInsideOut) {
    Mesh mesh = sphere(1.0F, 16, 8, 1.0F);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i], mesh.indices[i + 1]);
    const Topology t = examined(mesh);
    EXPECT_EQ(t.unmatchedEdges, 0U);
    EXPECT_LT(t.volumes.at(0), 0.0);
    EXPECT_EQ(t.contraryNormals, mesh.indices.size());
}

TEST(PolygonDeathTest, RefusesAClockwiseOutline) {
    const std::array<glm::vec2, 4> square{glm::vec2{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    EXPECT_DEATH(prism(square, 0.0F, 1.0F, 1.0F), "counter-clockwise");
}

TEST(Shapes, AWallSeenFromOutsideHasUToTheRightAndVDown) {
    const Mesh wall = box({-1, 0, -1}, {1, 2, 1}, 1.0F);
    for (const Vertex& v : wall.vertices) {
        if (v.normal.z < 0.9F) continue;  // the face towards +Z: right is +X
        EXPECT_NEAR(v.uv.x, v.position.x, 1e-6F);
        EXPECT_NEAR(v.uv.y, -v.position.y, 1e-6F);
    }
}

TEST(Shapes, WeldingKeepsEveryTriangle) {
    const Mesh mesh = sphere(1.0F, 16, 8, 1.0F);
    Mesh loose;
    for (const std::uint32_t index : mesh.indices) {
        loose.indices.push_back(static_cast<std::uint32_t>(loose.vertices.size()));
        loose.vertices.push_back(mesh.vertices[index]);
    }
    const Mesh tight = welded(loose);
    EXPECT_LT(tight.vertices.size(), loose.vertices.size());
    ASSERT_EQ(tight.indices.size(), loose.indices.size());
    for (std::size_t i = 0; i < tight.indices.size(); ++i) {
        EXPECT_EQ(tight.vertices[tight.indices[i]], loose.vertices[i]);
    }
}

}  // namespace
}  // namespace gnomon::demo
