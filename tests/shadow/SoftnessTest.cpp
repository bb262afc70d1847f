// How far around a place soft filters look at the most.
#include <gnomon/shadow_fit/Softness.h>
#include <gtest/gtest.h>

namespace gnomon::shadow_fit {
namespace {

using math::Box;
using math::dvec3;

/// A spot ten metres above the ground, of which it lights 10 m x 10 m.
class LookupReachTest : public testing::Test {
protected:
    double reach(std::vector<Box> casters) const {
        casters.push_back({.min = {-500.0, -0.1, -500.0}, .max = {500.0, 0.0, 500.0}});  // ground
        math::BoxTree tree;
        tree.build(std::move(casters));
        return lookupReach(*findFilterUse("ppcf"), light, 0.0, 0.0, receivers, tree);
    }
    static Box box(const dvec3& low, const dvec3& high) { return {.min = low, .max = high}; }
    /// Of a caster so far from the light; it may be up to a step more.
    void expectReach(double found, double caster) const {
        const double least = light.extent * (1.0 / caster - 1.0 / 10.0);
        EXPECT_GE(found, 0.999 * least);
        EXPECT_LE(found, 1.1 * least + 1e-3);
    }

    LightShape light{.kind = LightKind::spot,
                     .position = {0.0, 10.0, 0.0},
                     .direction = {0.0, -1.0, 0.0},
                     .halfAngle = 0.9,
                     .extent = 0.5};
    std::vector<dvec3> receivers{
        {-5.0, 0.0, -5.0}, {5.0, 0.0, -5.0}, {5.0, 0.0, 5.0}, {-5.0, 0.0, 5.0}};
};

TEST_F(LookupReachTest, GoesByTheCasterNearestToTheLight) {
    expectReach(reach({box({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0})}), 8.0);
    expectReach(
        reach({box({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}), box({2.0, 0.0, 2.0}, {3.0, 5.0, 3.0})}),
        5.0);
}

TEST_F(LookupReachTest, WhatStandsBesideTheRaysDoesNotCount) {
    const double alone = reach({box({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0})});
    EXPECT_EQ(
        reach({box({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}), box({8.0, 0.0, -1.0}, {9.0, 9.0, 1.0})}),
        alone);
}

TEST_F(LookupReachTest, OfALargeBoxThePartBetweenLightAndReceivers) {
    // A block that the rays pass at a height of 3.4 m, but for the light's radius.
    expectReach(reach({box({3.3, 0.0, -50.0}, {50.0, 9.0, 50.0})}), 10.0 * (3.3 - 0.56) / 5.0);
}

TEST_F(LookupReachTest, WhatStandsBetweenARayToTheRimAndTheOthersCounts) {
    // Beside the rays to the light's middle, not beside those to its rim.
    const double alone = reach({});
    EXPECT_GT(reach({box({1.3, 7.8, -1.0}, {2.0, 7.9, 1.0})}), 2.0 * alone + 0.01);
}

TEST_F(LookupReachTest, AmidCastersItIsTheMapsNearSide) {
    const double amid = reach({box({-1.0, 8.0, -1.0}, {1.0, 11.0, 1.0})});
    EXPECT_GT(amid, 1.0);
    EXPECT_LE(amid, 2.0);
}

TEST_F(LookupReachTest, WithoutExtentOrCastersItIsNothing) {
    EXPECT_LT(reach({}), 0.01);
    light.extent = 0.0;
    EXPECT_EQ(reach({box({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0})}), 0.0);
}

}  // namespace
}  // namespace gnomon::shadow_fit
