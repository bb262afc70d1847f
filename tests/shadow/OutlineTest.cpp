// The convex hull of what a light sees.
#include <gnomon/shadow_fit/Outline.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::shadow_fit {
namespace {

using math::dvec2;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// All in all, counter-clockwise, each corner one of the points.
void expectHull(const std::vector<dvec2>& points, const std::vector<dvec2>& hull) {
    double size = 0.0;
    for (const dvec2& p : points) size = std::max(size, glm::length(p - points.front()));
    for (std::size_t i = 0; i < hull.size(); ++i) {
        EXPECT_NE(std::find(points.begin(), points.end(), hull[i]), points.end());
        const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        for (const dvec2& p : points)
            ASSERT_GE(cross(edge, p - hull[i]), -1e-12 * size * size) << "corner " << i;
    }
}

TEST(ConvexHull, HoldsManyPointsOfEveryShape) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> share{-1.0, 1.0};
    for (int round = 0; round < 40; ++round) {
        const double angle = round * 0.37;
        const double flat = std::pow(10.0, -(round % 7));
        std::vector<dvec2> points;
        for (int i = 0; i < 500; ++i) {
            dvec2 p{share(random), share(random)};
            if (round % 3 == 1) p = glm::normalize(p);    // all of them are corners
            if (round % 3 == 2) p = glm::round(p * 4.0);  // a grid: many alike, many on an edge
            p.y *= flat;
            points.push_back(dvec2{p.x * std::cos(angle) - p.y * std::sin(angle),
                                   p.x * std::sin(angle) + p.y * std::cos(angle)} *
                                 100.0 +
                             dvec2{1e3, -1e4});
        }
        const auto hull = convexHull(points);
        ASSERT_GE(hull.size(), 3U);
        expectHull(points, hull);
    }
}

TEST(ConvexHull, IsWhatIsLeftOfPointsInALineOrAtOnePlace) {
    EXPECT_TRUE(convexHull({}).empty());
    EXPECT_EQ(convexHull(std::vector<dvec2>(100, {3.0, 4.0})).size(), 1U);
    std::vector<dvec2> line;
    for (int i = 0; i < 100; ++i) line.push_back({i * 1.0, 2.0});
    const auto hull = convexHull(line);
    EXPECT_NE(std::find(hull.begin(), hull.end(), line.front()), hull.end());
    EXPECT_NE(std::find(hull.begin(), hull.end(), line.back()), hull.end());
}

}  // namespace
}  // namespace gnomon::shadow_fit
