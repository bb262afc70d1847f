#include <gnomon/demo/Export.h>
#include <gnomon/demo/Scenes.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <sstream>
#include <string>

#include "Topology.h"

namespace gnomon::demo {
namespace {

struct Made {
    const char* name = "";
    Scene (*make)(std::uint64_t) = nullptr;
    std::size_t least = 0;  ///< triangles drawn
    std::size_t most = 0;
};

constexpr Made scenes[] = {
    {"plaza", [](std::uint64_t seed) { return plaza(seed, 16); }, 120'000, 250'000},
    // The reference grove has 113,904 triangles.
    {"grove", grove, 112'000, 116'000},
};

class EveryScene : public testing::TestWithParam<Made> {};

TEST_P(EveryScene, StaysInItsTriangleBudget) {
    for (const std::uint64_t seed : {1U, 2U, 77U}) {
        const std::size_t triangles = trianglesDrawn(GetParam().make(seed));
        EXPECT_GE(triangles, GetParam().least) << "seed " << seed;
        EXPECT_LE(triangles, GetParam().most) << "seed " << seed;
    }
}

TEST_P(EveryScene, IsTheSameForASeedAndAnotherForAnother) {
    const std::vector<std::uint8_t> first = toGlb(GetParam().make(5));
    EXPECT_TRUE(first == toGlb(GetParam().make(5)));
    EXPECT_FALSE(first == toGlb(GetParam().make(6)));
}

TEST_P(EveryScene, HasOnlyWatertightOutwardSolids) {
    const Scene scene = GetParam().make(1);
    std::size_t solids = 0;
    for (const MeshObject& object : scene.meshes) {
        for (const Primitive& part : object.primitives) {
            if (!part.closed) continue;
            SCOPED_TRACE(object.name + ", " + scene.materials[part.material].name);
            const Topology t = examined(part.mesh);
            EXPECT_EQ(t.unmatchedEdges, 0U);
            EXPECT_EQ(t.flatTriangles, 0U);
            EXPECT_EQ(t.contraryNormals, 0U);
            for (const double volume : t.volumes) EXPECT_GT(volume, 0.0);
            solids += t.volumes.size();
        }
    }
    EXPECT_GT(solids, 100U);
}

TEST_P(EveryScene, HasUnitNormalsFiniteTextureCoordinatesAndRightIndices) {
    const Scene scene = GetParam().make(1);
    for (const MeshObject& object : scene.meshes) {
        for (const Primitive& part : object.primitives) {
            SCOPED_TRACE(object.name);
            ASSERT_LT(part.material, scene.materials.size());
            const auto [low, high] =
                std::minmax_element(part.mesh.indices.begin(), part.mesh.indices.end());
            ASSERT_LT(*high, part.mesh.vertices.size());
            ASSERT_EQ(*low, 0U);
            float worst = 0.0F;
            float furthest = 0.0F;
            for (const Vertex& v : part.mesh.vertices) {
                worst = std::max(worst, std::abs(glm::length(v.normal) - 1.0F));
                furthest = std::max({furthest, std::abs(v.uv.x), std::abs(v.uv.y)});
            }
            EXPECT_LT(worst, 1e-4F);
            EXPECT_LT(furthest, 200.0F);
        }
    }
}

TEST_P(EveryScene, NamesEachNodeOnce) {
    const Scene scene = GetParam().make(1);
    std::set<std::string> names;
    for (const Node& node : scene.nodes) EXPECT_TRUE(names.insert(node.name).second) << node.name;
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::ValuesIn(scenes),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Plaza, OpenMeshesAreGroundOrSeenFromBothSides) {
    const Scene scene = plaza(1, 16);
    for (const MeshObject& object : scene.meshes) {
        for (const Primitive& part : object.primitives) {
            if (part.closed) continue;
            const bool isGround = object.name == "paving" || object.name == "hills";
            EXPECT_TRUE(isGround || scene.materials[part.material].doubleSided) << object.name;
        }
    }
}

TEST(Plaza, NothingButTreesAndHillsReachesBelowTheGround) {
    const Scene scene = plaza(1, 16);
    const std::vector<glm::mat4> worldFromNode = worldMatrices(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].mesh) continue;
        float lowest = std::numeric_limits<float>::max();
        float highest = std::numeric_limits<float>::lowest();
        for (const Primitive& part : scene.meshes[*scene.nodes[i].mesh].primitives) {
            for (const Vertex& v : part.mesh.vertices) {
                const float y = (worldFromNode[i] * glm::vec4{v.position, 1.0F}).y;
                lowest = std::min(lowest, y);
                highest = std::max(highest, y);
            }
        }
        EXPECT_GT(lowest, -3.0F) << scene.nodes[i].name;
        EXPECT_LT(highest, 30.0F) << scene.nodes[i].name;
    }
}

TEST(Plaza, EveryMovementRepeatsAfterOneLoop) {
    const Scene scene = plaza(1, 16);
    ASSERT_GT(scene.spins.size(), 8U);
    std::set<Index> moved;
    for (const Spin& spin : scene.spins) {
        SCOPED_TRACE(scene.nodes.at(spin.node).name);
        EXPECT_TRUE(moved.insert(spin.node).second) << "one channel a node";
        ASSERT_EQ(spin.seconds.size(), spin.rotations.size());
        EXPECT_FLOAT_EQ(spin.seconds.front(), 0.0F);
        EXPECT_FLOAT_EQ(spin.seconds.back(), scene.spins[0].seconds.back());
        EXPECT_GT(std::abs(glm::dot(spin.rotations.front(), spin.rotations.back())), 0.9999F);
        for (std::size_t i = 1; i < spin.seconds.size(); ++i) {
            EXPECT_GT(spin.seconds[i], spin.seconds[i - 1]);
            // Less than half a turn between keys, or linear interpolation goes the wrong way.
            EXPECT_GT(std::abs(glm::dot(spin.rotations[i], spin.rotations[i - 1])), 0.1F);
        }
    }
}

TEST(Plaza, HasOneSunThreeSpotsAndTheView) {
    const Scene scene = plaza(1, 16);
    const auto spots = std::count_if(scene.lights.begin(), scene.lights.end(),
                                     [](const Light& l) { return l.kind == Light::Kind::spot; });
    EXPECT_EQ(spots, 3);
    EXPECT_EQ(scene.lights.size(), 4U);
    ASSERT_EQ(scene.cameras.size(), 1U);
    const auto view = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                   [](const Node& n) { return n.name == "view"; });
    ASSERT_NE(view, scene.nodes.end());
    EXPECT_TRUE(view->camera.has_value());
    EXPECT_GE(view->translation.y, 3.0F);
    EXPECT_LE(view->translation.y, 4.0F);
}

TEST(Grove, IsA240MetreSquareOfPositionsAndFaces) {
    const Scene scene = grove(3);
    std::istringstream text{toObj(scene)};
    std::string word;
    std::size_t vertices = 0;
    std::size_t faces = 0;
    float low = 0.0F;
    float high = 0.0F;
    while (text >> word) {
        if (word == "v") {
            float x = 0.0F;
            float y = 0.0F;
            float z = 0.0F;
            ASSERT_TRUE(text >> x >> y >> z);
            low = std::min({low, x, z});
            high = std::max({high, x, z});
            ++vertices;
        } else {
            ASSERT_EQ(word, "f");
            for (int i = 0; i < 3; ++i) {
                std::size_t index = 0;
                ASSERT_TRUE(text >> index);
                ASSERT_GE(index, 1U);
                ASSERT_LE(index, vertices) << "faces follow their vertices";
            }
            ++faces;
        }
    }
    EXPECT_EQ(faces, trianglesDrawn(scene));
    EXPECT_FLOAT_EQ(low, -120.0F);
    EXPECT_FLOAT_EQ(high, 120.0F);
}

}  // namespace
}  // namespace gnomon::demo
