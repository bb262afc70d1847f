#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "mesh/Normals.h"
#include "mesh/Triangulate.h"

namespace gnomon::importer {
namespace {

/// Sum of the triangles' areas, each counted with its winding against the polygon's.
double signedArea(const std::vector<math::vec3>& polygon, const std::vector<std::uint32_t>& cut,
                  const math::dvec3& normal) {
    double area = 0.0;
    for (std::size_t i = 0; i < cut.size(); i += 3) {
        const double part =
            0.5 *
            glm::dot(areaNormal(polygon[cut[i]], polygon[cut[i + 1]], polygon[cut[i + 2]]), normal);
        EXPECT_GE(part, -1e-6) << "triangle " << i / 3 << " is turned over";
        area += part;
    }
    return area;
}

std::vector<math::vec3> star(std::size_t points) {
    std::vector<math::vec3> polygon;
    for (std::size_t i = 0; i < 2 * points; ++i) {
        const double angle =
            3.14159265358979 * static_cast<double>(i) / static_cast<double>(points);
        const double r = i % 2 == 0 ? 1.0 : 0.3;
        polygon.emplace_back(math::dvec3{r * std::cos(angle), r * std::sin(angle), 0.0});
    }
    return polygon;
}

TEST(Triangulate, CutsASquareInTwo) {
    const std::vector<math::vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<std::uint32_t> cut;
    triangulate(square, cut);
    EXPECT_EQ(cut, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Triangulate, CutsAnArrowheadAlongItsDent) {
    const std::vector<math::vec3> arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    std::vector<std::uint32_t> cut;
    triangulate(arrow, cut);
    ASSERT_EQ(cut.size(), 6U);
    EXPECT_NEAR(signedArea(arrow, cut, {0, 0, 1}), 1.0, 1e-9);
}

TEST(Triangulate, CoversAStarExactlyOnce) {
    for (const std::size_t points : {5U, 50U, 500U}) {
        const auto polygon = star(points);
        double area = 0.0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const auto& a = polygon[i];
            const auto& b = polygon[(i + 1) % polygon.size()];
            area += 0.5 * (double{a.x} * double{b.y} - double{b.x} * double{a.y});
        }
        std::vector<std::uint32_t> cut;
        triangulate(polygon, cut);
        EXPECT_EQ(cut.size(), (polygon.size() - 2) * 3);
        EXPECT_NEAR(signedArea(polygon, cut, {0, 0, 1}), area, 1e-5);
    }
}

TEST(Triangulate, KeepsTheWindingOfAPolygonInAnyPlane) {
    for (const bool reversed : {false, true}) {
        for (int axis = 0; axis < 3; ++axis) {
            auto polygon = star(5);
            for (auto& p : polygon)
                p = axis == 0   ? p
                    : axis == 1 ? math::vec3{p.z, p.x, p.y}
                                : math::vec3{p.y, p.z, p.x};
            math::dvec3 normal{0.0};
            normal[axis == 0 ? 2 : axis - 1] = reversed ? -1.0 : 1.0;
            if (reversed) std::reverse(polygon.begin(), polygon.end());
            std::vector<std::uint32_t> cut;
            triangulate(polygon, cut);
            EXPECT_GT(signedArea(polygon, cut, normal), 0.5);
        }
    }
}

TEST(Triangulate, GivesTheRightNumberEvenWhereThePolygonCrossesItself) {
    const std::vector<math::vec3> bowTie{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 3, 0}};
    std::vector<std::uint32_t> cut;
    triangulate(bowTie, cut);
    EXPECT_EQ(cut.size(), 9U);
}

TEST(Triangulate, IsBoundedOnTheLargestAndWorstPolygons) {
    using Clock = std::chrono::steady_clock;
    std::vector<math::vec3> grid;  // no simple polygon at all
    for (std::size_t i = 0; i < maxPolygonCorners; ++i)
        grid.emplace_back(static_cast<float>(i % 251), static_cast<float>(i / 251), 0.0F);
    for (const auto& polygon : {grid, star(maxPolygonCorners / 2)}) {
        const auto start = Clock::now();
        std::vector<std::uint32_t> cut;
        triangulate(polygon, cut);
        EXPECT_EQ(cut.size(), (polygon.size() - 2) * 3);
        EXPECT_LT(Clock::now() - start, std::chrono::seconds{20});
    }
}

TEST(Triangulate, TakesWhatIsNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<math::vec3> polygon{{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<std::uint32_t> cut;
    triangulate(polygon, cut);
    EXPECT_EQ(cut.size(), 6U);
}

}  // namespace
}  // namespace gnomon::importer
