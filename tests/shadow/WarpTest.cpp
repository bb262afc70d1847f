// Maps of a light's plane: what they must keep, and that the best one is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "BestWarp.h"

namespace gnomon::shadow_fit {
namespace {

using math::dmat3;
using math::dvec2;
using math::dvec3;

dvec2 mapped(const dmat3& map, const dvec2& p) {
    const dvec3 h = map * dvec3{p, 1.0};
    return dvec2{h} / h.z;
}

const std::vector<dvec2> outline{{0.0, 0.0}, {10.0, 1.0}, {14.0, 30.0}, {2.0, 33.0}, {-5.0, 20.0}};

TEST(PlaneMap, HoldsItsOutlineWithABorder) {
    const dvec2 along = glm::normalize(dvec2{0.3, 1.0});
    for (const double strength : {0.0, 0.5, 4.0, 40.0}) {
        const dmat3 map = warpedMap(outline, {.along = along, .strength = strength}, 256).value();
        double most = 0.0;
        for (const dvec2& p : outline) {
            EXPECT_GE((map * dvec3{p, 1.0}).z, 1.0 - 1e-12) << "w is 1 at the least";
            const dvec2 q = mapped(map, p);
            most = std::max({most, std::abs(q.x), std::abs(q.y)});
        }
        EXPECT_LT(most, 1.0 - 2.0 / 256.0);
        EXPECT_GT(most, 0.97);
    }
}

TEST(PlaneMap, StrengthIsHowMuchFinerTheNearSideIs) {
    const std::vector<dvec2> square{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    const dmat3 map =
        warpedMap(square, {.along = {0.0, 1.0}, .strength = 3.0, .beside = 0.5}, 4096).value();
    const auto across = [&](double y) {
        return mapped(map, {0.51, y}).x - mapped(map, {0.49, y}).x;
    };
    // w is 1 at the near side and 4 at the far one.
    EXPECT_NEAR(across(0.0) / across(1.0), 4.0, 1e-6);
}

TEST(PlaneMap, ZeroStrengthIsThePlainMap) {
    const dmat3 map = warpedMap(outline, {.along = {0.0, 1.0}, .strength = 0.0}, 256).value();
    EXPECT_EQ(map[0].z, 0.0);
    EXPECT_EQ(map[1].z, 0.0);
    EXPECT_EQ(map[2].z, 1.0);
}

/// Ground with samples on it as a view sees them: as many in each share of the picture.
struct Situation {
    LightShape light{.direction = glm::normalize(dvec3{0.4, -1.0, 0.3})};
    math::BoxTree tree;
    std::vector<math::View> views;
    Receivers receivers;
    std::vector<Sample> samples;
    FitInput input() const {
        return {.light = light,
                .views = views,
                .receivers = receivers,
                .samples = samples,
                .scene = tree.bounds(),
                .mapSize = 1024};
    }
};

void look(Situation& s, std::mt19937& random) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>{low, high}(random);
    };
    s.tree.build({{.min = {-60.0, 0.0, -60.0}, .max = {60.0, 0.0, 60.0}},
                  {.min = {-60.0, 4.0, -60.0}, .max = {60.0, 4.5, 60.0}}});
    s.light.direction =
        glm::normalize(dvec3{between(-1.0, 1.0), between(-1.5, -0.2), between(-1.0, 1.0)});
    s.views = {{.clipFromEye = math::perspective(1.0, 1.3, 0.1, 300.0),
                .eyeFromWorld = math::lookAt({0.0, between(1.0, 20.0), 40.0}, {0.0, 1.0, 0.0},
                                             {0.0, 1.0, 0.0})}};
    s.receivers.clear();
    s.receivers.add(s.views[0], &s.light, s.tree);
    s.samples = samplePicture(s.views, {.tree = s.tree}, 16);
}

TEST(BestWarp, IsNeverExpectedToErrMoreThanWhatItIsGuessedFrom) {
    std::mt19937 random{5};
    int better = 0;
    for (int round = 0; round < 60; ++round) {
        Situation s;
        look(s, random);
        const Ground ground{s.input()};
        const auto viewer = viewerOf(s.input());
        ASSERT_TRUE(viewer.has_value());
        const dvec2 along = glm::normalize(ground.plane.moved(dvec3{0.0}, viewer->forward));
        const Warp guess{.along = along, .strength = 3.0};
        const auto expected = [&](const dmat3& map) {
            return expectedError(ground.plane, map, 1024, s.samples);
        };
        const double best = expected(bestWarp(ground, guess, 1024, s.samples).value());
        const double guessed = expected(warpedMap(ground.outline.hull, guess, 1024).value());
        // Its border and its parallelogram's reach differ a little from the guess's.
        EXPECT_LT(best, guessed * 1.02) << "round " << round;
        better += best < 0.9 * guessed ? 1 : 0;
    }
    EXPECT_GT(better, 20);
}

TEST(BestWarp, HoldsTheWholeOutline) {
    std::mt19937 random{6};
    for (int round = 0; round < 60; ++round) {
        Situation s;
        look(s, random);
        const Ground ground{s.input()};
        const dmat3 map =
            bestWarp(ground, {.along = {0.0, 1.0}, .strength = 2.0}, 1024, s.samples).value();
        for (const dvec2& p : ground.outline.hull) {
            EXPECT_GE((map * dvec3{p, 1.0}).z, 1.0 - 1e-9);
            const dvec2 q = mapped(map, p);
            EXPECT_LE(std::max(std::abs(q.x), std::abs(q.y)), 1.0);
        }
    }
}

TEST(ExpectedError, IsTheMeanSideOfATexel) {
    // Parallel light straight down on a square of 10 m, in 100 texels: 10 cm each.
    const LightShape light{.direction = {0.0, -1.0, 0.0}};
    const LightPlane plane{light};
    const auto at = [&](const dvec3& p) { return dvec2{plane.at(p)}; };
    const std::vector<dvec2> square{at({0.0, 0.0, 0.0}), at({10.0, 0.0, 0.0}),
                                    at({10.0, 0.0, 10.0}), at({0.0, 0.0, 10.0})};
    const dmat3 map = uniformMap(convexHull(square), 100000);
    const std::vector<Sample> samples{{.world = {5.0, 0.0, 5.0}}, {.world = {2.0, 1.0, 7.0}}};
    EXPECT_NEAR(expectedError(plane, map, 100, samples), 0.1, 1e-4);
    EXPECT_NEAR(expectedError(plane, map, 200, samples), 0.05, 1e-4);
}

}  // namespace
}  // namespace gnomon::shadow_fit
