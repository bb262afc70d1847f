// Clipping of convex bodies, against volumes and points that are known.
#include <gnomon/math/ConvexBody.h>
#include <gnomon/math/View.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gnomon::math {
namespace {

const Box unitBox{.min = dvec3{0.0}, .max = dvec3{1.0}};

Box boundsOf(const ConvexBody& body) {
    Box box;
    for (const dvec3& p : body.points()) box.add(p);
    return box;
}

std::vector<dvec3> corners(const ConvexBody& body) {
    std::vector<dvec3> all;
    for (const dvec3& p : body.points())
        if (std::none_of(all.begin(), all.end(),
                         [&](const dvec3& q) { return glm::length(p - q) < 1e-9; }))
            all.push_back(p);
    return all;
}

Plane planeThrough(const dvec3& point, const dvec3& normal) {
    const dvec3 n = glm::normalize(normal);
    return {.normal = n, .offset = -glm::dot(n, point)};
}

TEST(ConvexBody, OfABoxHasItsCorners) {
    const ConvexBody body{unitBox};
    EXPECT_FALSE(body.empty());
    EXPECT_EQ(corners(body).size(), 8U);
    EXPECT_EQ(boundsOf(body), unitBox);
    EXPECT_TRUE(ConvexBody{Box{}}.empty());
    EXPECT_TRUE(ConvexBody{}.empty());
}

TEST(ConvexBody, APlaneThatCutsACornerLeavesTenCorners) {
    ConvexBody body{unitBox};
    body.clip(planeThrough({0.5, 0.0, 0.0}, {1.0, 1.0, 1.0}));
    const auto left = corners(body);
    EXPECT_EQ(left.size(), 10U);  // seven old ones and a triangle
    for (const dvec3& p : {dvec3{0.5, 0.0, 0.0}, dvec3{0.0, 0.5, 0.0}, dvec3{0.0, 0.0, 0.5}})
        EXPECT_TRUE(std::any_of(left.begin(), left.end(),
                                [&](const dvec3& q) { return glm::length(p - q) < 1e-12; }));
}

TEST(ConvexBody, PlanesBesideItLeaveAllOrNothing) {
    ConvexBody body{unitBox};
    body.clip(planeThrough({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
    EXPECT_EQ(corners(body).size(), 8U);
    body.clip(planeThrough({2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
    EXPECT_TRUE(body.empty());
    body.clip(planeThrough({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
    EXPECT_TRUE(body.empty());
    EXPECT_TRUE(body.points().empty());
}

TEST(ConvexBody, ClippedByABoxIsTheIntersection) {
    std::mt19937 random{1};
    std::uniform_real_distribution<double> u{-2.0, 2.0};
    for (int i = 0; i < 300; ++i) {
        Box a;
        Box b;
        for (int k = 0; k < 2; ++k) {
            a.add(dvec3{u(random), u(random), u(random)});
            b.add(dvec3{u(random), u(random), u(random)});
        }
        ConvexBody body{a};
        body.clip(b);
        const Box expected{.min = glm::max(a.min, b.min), .max = glm::min(a.max, b.max)};
        ASSERT_EQ(body.empty(), expected.empty());
        if (body.empty()) continue;
        const Box found = boundsOf(body);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(found.min[k], expected.min[k], 1e-12);
            EXPECT_NEAR(found.max[k], expected.max[k], 1e-12);
        }
    }
    ConvexBody body{unitBox};
    body.clip(Box{});
    EXPECT_TRUE(body.empty());
}

TEST(ConvexBody, RandomCutsKeepEverythingInsideAndNothingElse) {
    std::mt19937 random{2};
    std::uniform_real_distribution<double> u{-1.0, 1.0};
    for (int i = 0; i < 200; ++i) {
        ConvexBody body{Box{.min = dvec3{-1.0}, .max = dvec3{1.0}}};
        std::vector<Plane> planes;
        for (int k = 0; k < 4; ++k) {
            planes.push_back(planeThrough(0.8 * dvec3{u(random), u(random), u(random)},
                                          {u(random), u(random), u(random)}));
            body.clip(planes.back());
        }
        const auto all = corners(body);
        for (const dvec3& p : all)
            for (const Plane& plane : planes) EXPECT_GE(plane.distance(p), -1e-9);
        // The support in any direction is the largest found by sampling, and no smaller.
        for (int k = 0; k < 300; ++k) {
            const dvec3 p{u(random), u(random), u(random)};
            if (std::any_of(planes.begin(), planes.end(),
                            [&](const Plane& plane) { return plane.distance(p) < 0.0; }))
                continue;
            ASSERT_FALSE(all.empty());
            const dvec3 direction = glm::normalize(dvec3{u(random), u(random), u(random)});
            double support = -HUGE_VAL;
            for (const dvec3& q : all) support = std::max(support, glm::dot(q, direction));
            EXPECT_GE(support, glm::dot(p, direction) - 1e-9);
        }
    }
}

TEST(ConvexBody, StaysClosedThroughManyCuts) {
    // A ball cut from a box: every cut needs the closing faces of those before.
    ConvexBody body{Box{.min = dvec3{-2.0}, .max = dvec3{2.0}}};
    std::mt19937 random{3};
    std::normal_distribution<double> g;
    for (int i = 0; i < 300; ++i) {
        const dvec3 n = glm::normalize(dvec3{g(random), g(random), g(random)});
        body.clip(planeThrough(n, -n));
    }
    for (int i = 0; i < 300; ++i) {
        const dvec3 n = glm::normalize(dvec3{g(random), g(random), g(random)});
        double support = -HUGE_VAL;
        for (const dvec3& p : body.points()) support = std::max(support, glm::dot(p, n));
        EXPECT_GE(support, 1.0 - 1e-9);
        EXPECT_LE(support, 1.2);
    }
}

TEST(ConvexBody, DegenerateInputsDoNotCrash) {
    ConvexBody flat{Box{.min = dvec3{0.0}, .max = dvec3{1.0, 1.0, 0.0}}};
    flat.clip(planeThrough({0.5, 0.5, 0.0}, {1.0, 0.0, 0.0}));
    EXPECT_EQ(boundsOf(flat).min.x, 0.5);
    ConvexBody point{Box{.min = dvec3{1.0}, .max = dvec3{1.0}}};
    point.clip(planeThrough({1.0, 1.0, 1.0}, {0.0, 1.0, 0.0}));
    for (const dvec3& p : point.points()) EXPECT_EQ(p, dvec3{1.0});
    // Planes exactly through faces, edges and corners, again and again.
    ConvexBody body{unitBox};
    for (int i = 0; i < 8; ++i) body.clip(unitBox);
    EXPECT_EQ(boundsOf(body), unitBox);
    body.clip(planeThrough({0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}));
    body.clip(planeThrough({1.0, 1.0, 1.0}, {-1.0, -1.0, -1.0}));
    EXPECT_EQ(boundsOf(body), unitBox);
    body.clip(planeThrough({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}));
    for (const dvec3& p : body.points()) EXPECT_LT(glm::length(p - dvec3{1.0}), 1e-12);
}

TEST(ConvexBody, AViewVolumeCutByTheSceneStaysInBoth) {
    const dmat4 clip = perspective(1.0, 1.5, 0.1, 1000.0) *
                       lookAt({5.0, 2.0, 8.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    const Box scene{.min = {-3.0, 0.0, -3.0}, .max = {3.0, 2.0, 3.0}};
    ConvexBody body{frustumCorners(clip)};
    body.clip(scene);
    ASSERT_FALSE(body.empty());
    const auto planes = frustumPlanes(clip);
    for (const dvec3& p : body.points()) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(p[k], scene.min[k] - 1e-7);
            EXPECT_LE(p[k], scene.max[k] + 1e-7);
        }
        for (const Plane& plane : planes) EXPECT_GE(plane.distance(p), -1e-6);
    }
}

}  // namespace
}  // namespace gnomon::math
