#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Types.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Model.h"
#include "Shapes.h"
#include "mesh/BuildGeometry.h"
#include "mesh/Normals.h"
#include "mesh/Tangents.h"

namespace gnomon::importer {
namespace {

class Mesh : public testing::Test {
protected:
    static field::TypeRegistry makeTypes() {
        field::TypeRegistry types;
        scene::addTypes(types);
        return types;
    }
    static MeshData meshOf(const Shape& shape) {
        MeshData mesh;
        mesh.positions = shape.positions;
        mesh.indices = shape.indices;
        return mesh;
    }
    const scene::Geometry* build(MeshData mesh, bool tangents = false) {
        return buildGeometry(aspect_, std::move(mesh), tangents, report_, "mesh");
    }

    field::TypeRegistry types_ = makeTypes();
    field::Aspect aspect_{types_, 0, true};
    Report report_;
};

TEST_F(Mesh, SharesEqualVerticesOfTrianglesThatHaveTheirOwn) {
    const auto* g = build(meshOf(sphere(16, 8).unshared()));
    ASSERT_NE(g, nullptr);
    EXPECT_EQ(vectors<math::vec3>(g->positions).size(), sphere(16, 8).positions.size());
    EXPECT_EQ(faultsOf(*g), "");
}

TEST_F(Mesh, KeepsVerticesApartThatDifferInAnythingButTheirPlace) {
    auto mesh = meshOf(cube().unshared());
    addFlatNormals(mesh);
    const auto* g = build(mesh);
    ASSERT_NE(g, nullptr);
    EXPECT_EQ(vectors<math::vec3>(g->positions).size(), 24U);
    for (const auto& chunk : g->chunks) EXPECT_TRUE(chunk.closed);
}

TEST_F(Mesh, MarksClosedChunksAndNoOthers) {
    auto shape = plane(40);
    shape.add(sphere(40, 30), {100.0F, 0.0F, 0.0F});
    const auto* g = build(meshOf(shape));
    ASSERT_NE(g, nullptr);
    EXPECT_EQ(faultsOf(*g), "");
    std::size_t closed = 0;
    for (const auto& chunk : g->chunks) {
        EXPECT_EQ(chunk.closed, chunk.min.x > 50.0F);
        if (chunk.closed) closed += chunk.indexCount / 3;
    }
    EXPECT_EQ(closed, sphere(40, 30).triangles());
}

TEST_F(Mesh, DropsTrianglesWithPositionsThatAreNotFiniteOrTooFar) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), -3e38F}) {
        auto shape = plane(2);
        shape.positions[0].y = bad;  // a corner of two of the eight triangles
        Report report;
        const auto* g = buildGeometry(aspect_, meshOf(shape), false, report, "mesh");
        ASSERT_NE(g, nullptr);
        EXPECT_EQ(faultsOf(*g), "");
        EXPECT_EQ(g->indices->as<std::uint32_t>().size(), 6U * 3);
        ASSERT_EQ(report.warnings().size(), 1U);
        EXPECT_NE(report.warnings()[0].find("mesh: 2 of 8 triangles dropped"), std::string::npos);
    }
}

TEST_F(Mesh, IsNothingWhereAllIsDropped) {
    auto shape = plane(1);
    for (auto& p : shape.positions) p.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(build(meshOf(shape)), nullptr);
}

TEST_F(Mesh, TakesTrianglesThatAreAllOnePoint) {
    auto shape = cube();
    for (auto& p : shape.positions) p = math::vec3{3.0F};
    auto mesh = meshOf(shape);
    mesh.normals.assign(mesh.positions.size(), math::vec3{0.0F});
    const auto* g = build(mesh);
    ASSERT_NE(g, nullptr);
    EXPECT_EQ(faultsOf(*g), "");
    EXPECT_EQ(g->boundsMin.get(), g->boundsMax.get());
    for (const auto& chunk : g->chunks) EXPECT_FALSE(chunk.closed);
}

TEST_F(Mesh, MendsNormalsThatAreNone) {
    auto mesh = meshOf(plane(3));
    mesh.normals.assign(mesh.positions.size(), math::vec3{0.0F, 7.0F, 0.0F});
    mesh.normals[5] = math::vec3{0.0F};
    mesh.normals[6].x = std::numeric_limits<float>::quiet_NaN();
    const auto* g = build(mesh);
    ASSERT_NE(g, nullptr);
    for (const auto& n : vectors<math::vec3>(g->normals))
        EXPECT_EQ(n, (math::vec3{0.0F, 1.0F, 0.0F}));
}

TEST(CreasedNormals, AreSmoothOnABall) {
    const auto ball = sphere(48, 24).unshared();
    const auto normals = creasedNormals(ball.positions, ball.indices);
    for (std::size_t i = 0; i < normals.size(); ++i)
        EXPECT_GT(glm::dot(normals[i], glm::normalize(ball.positions[ball.indices[i]])), 0.995F);
}

TEST(CreasedNormals, AreTheFacesOwnOnACube) {
    const auto box = cube();
    const auto normals = creasedNormals(box.positions, box.indices);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const auto* c = &box.indices[i / 3 * 3];
        const auto face =
            unitOr(areaNormal(box.positions[c[0]], box.positions[c[1]], box.positions[c[2]]),
                   math::vec3{0.0F});
        EXPECT_NEAR(glm::dot(normals[i], face), 1.0F, 1e-6F);
    }
}

TEST(CreasedNormals, AreUnitVectorsWhateverTheTriangles) {
    Shape shape = plane(2);
    shape.positions[1] = shape.positions[0];
    shape.positions[4] = math::vec3{std::numeric_limits<float>::infinity()};
    shape.indices.insert(shape.indices.end(), {7, 7, 7});
    for (const auto& n : creasedNormals(shape.positions, shape.indices))
        EXPECT_NEAR(glm::length(n), 1.0F, 1e-5F);
}

TEST(CreasedNormals, TakeAFanOfManyFacesInTime) {
    Shape fan;  // quadratic without the bound: 4e10 comparisons
    fan.positions.emplace_back(0.0F, 0.5F, 0.0F);
    constexpr std::uint32_t sides = 200000;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double a = 6.283185307179586 * i / sides;
        fan.positions.emplace_back(math::dvec3{std::cos(a), 0.0, -std::sin(a)});
        fan.indices.insert(fan.indices.end(), {0, 1 + i, 1 + (i + 1) % sides});
    }
    const auto normals = creasedNormals(fan.positions, fan.indices);
    EXPECT_NEAR(normals[0].y, 1.0F, 1e-3F);
}

/// A square in the xy plane with its texture upright: u to the right, v down.
MeshData texturedSquare() {
    MeshData mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, math::vec3{0.0F, 0.0F, 1.0F});
    mesh.texCoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

TEST(Tangents, PointAlongGrowingUWithUpGivenByTheHandedness) {
    auto mesh = texturedSquare();
    addTangents(mesh);
    ASSERT_EQ(mesh.tangents.size(), 4U);
    for (const auto& t : mesh.tangents) {
        EXPECT_EQ(t, (math::vec4{1.0F, 0.0F, 0.0F, 1.0F}));
        // cross(normal, tangent) * w is where the map's +y points: up in the image.
        EXPECT_EQ(glm::cross(math::vec3{0, 0, 1}, math::vec3{t.x, t.y, t.z}) * t.w,
                  (math::vec3{0, 1, 0}));
    }
}

TEST(Tangents, SplitVerticesBetweenMirroredHalves) {
    // A second square to the left whose u grows to the left: vertices 0 and 3 are shared.
    auto mesh = texturedSquare();
    mesh.positions.insert(mesh.positions.end(), {{-1, 0, 0}, {-1, 1, 0}});
    mesh.normals.resize(6, math::vec3{0.0F, 0.0F, 1.0F});
    mesh.texCoords.insert(mesh.texCoords.end(), {{1, 1}, {1, 0}});
    mesh.indices.insert(mesh.indices.end(), {4, 0, 3, 4, 3, 5});
    addTangents(mesh);
    EXPECT_EQ(mesh.positions.size(), 8U);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const auto& t = mesh.tangents[mesh.indices[i]];
        EXPECT_EQ(t, (i < 6 ? math::vec4{1, 0, 0, 1} : math::vec4{-1, 0, 0, -1})) << i;
    }
}

TEST(Tangents, AreOrthogonalUnitVectorsWithoutTextureArea) {
    auto mesh = texturedSquare();
    for (auto& t : mesh.texCoords) t = math::vec2{0.5F};
    addTangents(mesh);
    for (const auto& t : mesh.tangents) {
        const math::vec3 direction{t.x, t.y, t.z};
        EXPECT_NEAR(glm::length(direction), 1.0F, 1e-6F);
        EXPECT_NEAR(direction.z, 0.0F, 1e-6F);
    }
}

TEST_F(Mesh, GivesAFlatMeshNormalsWhereTangentsNeedThem) {
    auto mesh = texturedSquare();
    mesh.normals.clear();
    const auto* g = build(mesh, true);
    ASSERT_NE(g, nullptr);
    EXPECT_EQ(vectors<math::vec3>(g->normals).size(), 4U);
    EXPECT_EQ(vectors<math::vec4>(g->tangents).size(), 4U);
    const auto* flat = build(mesh, false);
    ASSERT_NE(flat, nullptr);
    EXPECT_EQ(flat->normals->size(), 0U);
    EXPECT_EQ(flat->tangents->size(), 0U);
}

}  // namespace
}  // namespace gnomon::importer
