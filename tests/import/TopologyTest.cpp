#include <gtest/gtest.h>

#include <algorithm>

#include "Shapes.h"
#include "mesh/Chunks.h"
#include "mesh/Topology.h"

namespace gnomon::importer {
namespace {

std::size_t closedCount(const Shape& shape) {
    const auto welded = weldedPositions(shape.positions);
    std::vector<std::uint32_t> corners;
    for (const auto i : shape.indices) corners.push_back(welded[i]);
    const auto closed = closedTriangles(corners, shape.positions.size());
    return static_cast<std::size_t>(std::count(closed.begin(), closed.end(), true));
}

TEST(Closed, KnowsACubeWhoseFacesShareNoVertices) {
    EXPECT_EQ(closedCount(cube()), 12U);
    EXPECT_EQ(closedCount(cube().unshared()), 12U);
}

TEST(Closed, KnowsASphere) {
    const auto ball = sphere(32, 16);
    EXPECT_EQ(ball.triangles(), 32U * 15 * 2);
    EXPECT_EQ(closedCount(ball), ball.triangles());
}

TEST(Closed, ThinksNothingOfAPlane) { EXPECT_EQ(closedCount(plane(8)), 0U); }

TEST(Closed, IsSpoiledByOneMissingTriangle) {
    auto shape = cube();
    shape.indices.resize(shape.indices.size() - 3);
    EXPECT_EQ(closedCount(shape), 0U);
}

TEST(Closed, IsSpoiledByOneTriangleTheOtherWayRound) {
    auto shape = cube();
    std::swap(shape.indices[0], shape.indices[1]);
    EXPECT_EQ(closedCount(shape), 0U);
}

TEST(Closed, TakesAnInsideOutCube) {
    auto shape = cube();
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
        std::swap(shape.indices[i], shape.indices[i + 1]);
    EXPECT_EQ(closedCount(shape), 12U);
}

TEST(Closed, TellsTheClosedPartsOfAMeshFromTheOpenOnes) {
    auto shape = plane(4);
    shape.add(sphere(8, 6), {10.0F, 0.0F, 0.0F});
    shape.add(cube(), {20.0F, 0.0F, 0.0F});
    EXPECT_EQ(closedCount(shape), sphere(8, 6).triangles() + 12);
}

TEST(Closed, IsNotSpoiledByAnOpenSurfaceThatTouchesInAPoint) {
    auto shape = cube();
    shape.add(plane(1), {1.0F, 1.0F, 1.0F});
    EXPECT_EQ(closedCount(shape), 12U);
}

TEST(Closed, IsSpoiledByAThirdFaceOnAnEdge) {
    auto shape = cube();
    shape.positions.emplace_back(5.0F, 5.0F, 5.0F);
    shape.indices.insert(shape.indices.end(), {0, 1, 8});
    EXPECT_EQ(closedCount(shape), 0U);
}

TEST(Closed, LeavesOutTrianglesWithTwoEqualCorners) {
    auto shape = cube();
    shape.indices.insert(shape.indices.end(), {0, 0, 1, 3, 3, 3});
    EXPECT_EQ(closedCount(shape), 12U);
}

TEST(Weld, JoinsZeroAndMinusZeroAndKeepsNansApartFromNumbers) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<math::vec3> positions{{0.0F, 1.0F, 2.0F}, {-0.0F, 1.0F, 2.0F}, {1.0F, 1.0F, 2.0F}};
    positions.resize(200000, math::vec3{nan});  // of one hash: must not take quadratic time
    const auto welded = weldedPositions(positions);
    EXPECT_EQ(welded[0], 0U);
    EXPECT_EQ(welded[1], 0U);
    EXPECT_EQ(welded[2], 2U);
    EXPECT_EQ(welded.back(), 3U);
}

TEST(Chunks, KeepClosedAndOpenApartAndCoverEverything) {
    auto shape = plane(60);
    shape.add(sphere(64, 40), {200.0F, 0.0F, 0.0F});
    const auto welded = weldedPositions(shape.positions);
    const auto closed = closedTriangles(shape.indices, shape.positions.size());
    auto indices = shape.indices;
    const auto chunks = cutIntoChunks(shape.positions, indices, 3, closed);

    std::uint32_t next = 0;
    for (const auto& chunk : chunks) {
        EXPECT_EQ(chunk.firstIndex, next);
        EXPECT_LE(chunk.indexCount, 3 * chunkSize);
        EXPECT_GE(chunk.indexCount, 3 * chunkSize / 2);  // nearly equal, not a sliver
        next += chunk.indexCount;
        for (auto i = chunk.firstIndex; i < next; ++i)
            EXPECT_EQ(shape.positions[indices[i]].x > 100.0F, chunk.closed);
    }
    EXPECT_EQ(next, indices.size());
    auto sorted = [](std::vector<std::uint32_t> v) {
        std::sort(v.begin(), v.end());
        return v;
    };
    EXPECT_EQ(sorted(indices), sorted(shape.indices));
}

TEST(Chunks, LieTogetherInSpace) {
    const auto shape = plane(64);  // 8192 triangles: eight chunks of a quarter and an eighth
    auto indices = shape.indices;
    const auto chunks = cutIntoChunks(shape.positions, indices, 3, {});
    ASSERT_EQ(chunks.size(), 8U);
    for (const auto& chunk : chunks) {
        const auto size = chunk.max - chunk.min;
        EXPECT_LE(size.x * size.z, 64.0F * 64.0F / 8.0F * 1.3F);
    }
}

}  // namespace
}  // namespace gnomon::importer
