// What is seen, and what of it a shadow map need not hold.
#include <gnomon/shadow_fit/Fit.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::shadow_fit {
namespace {

using math::Box;
using math::dvec3;

math::View lookDown(const dvec3& eye, const dvec3& to) {
    return {.clipFromEye = math::perspective(1.0, 1.0, 0.1, 200.0),
            .eyeFromWorld = math::lookAt(eye, to, {0.0, 1.0, 0.0})};
}

Box boxOf(const dvec3& low, const dvec3& high) { return {.min = low, .max = high}; }

double furthest(const Receivers& receivers, const dvec3& direction) {
    double most = -HUGE_VAL;
    for (const dvec3& p : receivers.points()) most = std::max(most, glm::dot(p, direction));
    return most;
}

class ReceiversTest : public testing::Test {
protected:
    /// A ground of 200 m, and a post of 2 m on it.
    ReceiversTest() {
        tree.build({boxOf({-100.0, 0.0, -100.0}, {100.0, 0.0, 100.0}),
                    boxOf({-0.2, 0.0, -0.2}, {0.2, 2.0, 0.2})});
    }
    math::BoxTree tree;
    const math::View view = lookDown({0.0, 3.0, 12.0}, {0.0, 0.0, 0.0});
    const LightShape noon{.direction = {0.0, -1.0, 0.0}};
    const LightShape afternoon{.direction = glm::normalize(dvec3{1.0, -1.0, 0.0})};
};

TEST_F(ReceiversTest, AreWhatTheViewSees) {
    Receivers receivers;
    receivers.add(view, nullptr, tree);
    EXPECT_EQ(receivers.pieces(), 2U);
    const auto planes = math::frustumPlanes(view.clipFromWorld());
    for (const dvec3& p : receivers.points())
        for (const math::Plane& plane : planes) EXPECT_GE(plane.distance(p), -1e-9);
    EXPECT_NEAR(furthest(receivers, {0.0, 1.0, 0.0}), 2.0, 1e-12);
}

TEST_F(ReceiversTest, GroundThatNothingStandsOverIsDropped) {
    for (const LightShape* light : {&noon, &afternoon}) {
        Receivers receivers;
        receivers.add(view, light, tree);
        EXPECT_GT(furthest(receivers, {0.0, 0.0, -1.0}), 80.0) << "seen to the horizon";
        EXPECT_TRUE(receivers.mayBeShadowed(*light, tree));
        receivers.dropUnshadowed(*light, tree);
        ASSERT_FALSE(receivers.empty());
        // The post, and its shadow: to its foot at noon, two metres long in the afternoon.
        const double shadow = light == &noon ? 0.2 : 2.2;
        EXPECT_GE(furthest(receivers, {1.0, 0.0, 0.0}), shadow - 1e-9);
        EXPECT_LE(furthest(receivers, {1.0, 0.0, 0.0}), shadow + 2.0);
        EXPECT_LE(furthest(receivers, {-1.0, 0.0, 0.0}), 2.0);
        EXPECT_LE(furthest(receivers, {0.0, 0.0, -1.0}), 2.5);
    }
}

TEST_F(ReceiversTest, WithoutAnythingThatCastsNothingIsLeft) {
    math::BoxTree ground;
    ground.build({boxOf({-100.0, 0.0, -100.0}, {100.0, 0.0, 0.0}),
                  boxOf({-100.0, 0.0, 0.0}, {100.0, 0.0, 100.0})});
    for (const LightShape* light : {&noon, &afternoon}) {
        Receivers receivers;
        receivers.add(view, light, ground);
        EXPECT_FALSE(receivers.mayBeShadowed(*light, ground));
        receivers.dropUnshadowed(*light, ground);
        EXPECT_TRUE(receivers.empty()) << "neighbours in one plane do not shadow each other";
    }
}

TEST_F(ReceiversTest, ASpotsGroundIsDroppedToo) {
    LightShape spot{.kind = LightKind::spot, .position = {0.0, 8.0, 0.0}, .halfAngle = 0.9};
    Receivers receivers;
    receivers.add(view, &spot, tree);
    const double before = furthest(receivers, {0.0, 0.0, -1.0});
    receivers.dropUnshadowed(spot, tree);
    ASSERT_FALSE(receivers.empty());
    // The post's top is 6 m below the light: its shadow is a third wider than it.
    EXPECT_LT(furthest(receivers, {0.0, 0.0, -1.0}), 1.5);
    EXPECT_GT(before, 5.0);
}

TEST_F(ReceiversTest, NoShadowedPlaceIsDropped) {
    // Many posts, from all sides: whatever a ray from the ground meets stays within the outline.
    std::vector<Box> boxes{boxOf({-50.0, 0.0, -50.0}, {50.0, 0.0, 50.0})};
    for (int i = 0; i < 40; ++i) {
        const double x = std::fmod(i * 7.3, 60.0) - 30.0;
        const double z = std::fmod(i * 11.7, 60.0) - 30.0;
        boxes.push_back(boxOf({x, 0.0, z}, {x + 0.5, 1.0 + i % 5, z + 0.5}));
    }
    math::BoxTree yard;
    yard.build(boxes);
    for (int round = 0; round < 12; ++round) {
        const double turn = round * 0.5236;
        const LightShape light{.direction =
                                   glm::normalize(dvec3{std::cos(turn), -0.7, std::sin(turn)})};
        Receivers receivers;
        receivers.add(view, &light, yard);
        receivers.dropUnshadowed(light, yard);
        // Support of the outline across the light, in many directions.
        const auto [u, v] = perpendicular(-light.direction);
        for (double x = -30.0; x < 30.0; x += 0.7) {
            for (double z = -40.0; z < 8.0; z += 0.7) {
                const dvec3 p{x, 0.0, z};
                const math::dvec4 clip = view.clipFromWorld() * math::dvec4{p, 1.0};
                if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
                bool shadowed = false;
                yard.along(p, -light.direction, [&](std::uint32_t item, double, double exit) {
                    shadowed = shadowed || (item > 0 && exit > 1e-6);
                });
                if (!shadowed) continue;
                for (int k = 0; k < 16; ++k) {
                    const double a = k * 0.3927;
                    const dvec3 direction = u * std::cos(a) + v * std::sin(a);
                    ASSERT_GE(furthest(receivers, direction), glm::dot(p, direction) - 1e-6)
                        << "round " << round << " at " << x << ", " << z;
                }
            }
        }
    }
}

TEST(Samples, AreWhereThePictureSeesSomething) {
    math::BoxTree tree;
    tree.build({boxOf({-100.0, 0.0, -100.0}, {100.0, 0.0, 100.0})});
    const std::vector views{lookDown({0.0, 3.0, 12.0}, {0.0, 0.0, 0.0})};
    const auto samples = samplePicture(views, {.tree = tree}, 16);
    EXPECT_GT(samples.size(), 100U);
    for (const Sample& sample : samples) EXPECT_NEAR(sample.world.y, 0.0, 1e-9);
}

TEST(Samples, AThinCloudLetsRaysThrough) {
    math::BoxTree tree;
    tree.build({boxOf({-100.0, 0.0, -100.0}, {100.0, 0.0, 100.0}),
                boxOf({-20.0, 0.0, 0.0}, {20.0, 40.0, 4.0})});
    const std::vector views{lookDown({0.0, 3.0, 12.0}, {0.0, 0.0, 0.0})};
    const auto share = [&](double density) {
        const std::vector densities{HUGE_VAL, density};
        const auto samples = samplePicture(views, {.tree = tree, .density = densities}, 32);
        const auto within = std::count_if(samples.begin(), samples.end(),
                                          [](const Sample& s) { return s.world.y > 1e-6; });
        return static_cast<double>(within) / static_cast<double>(samples.size());
    };
    EXPECT_EQ(share(0.0), 0.0);
    EXPECT_GT(share(100.0), 0.5) << "as much as a solid box would stop";
    EXPECT_GT(share(0.05), 0.02);
    EXPECT_LT(share(0.05), share(0.3));
}

TEST(Samples, CountWhereAnEdgeOfAShadowIsLikely) {
    math::BoxTree tree;
    tree.build({boxOf({-100.0, 0.0, -100.0}, {100.0, 0.0, 100.0}),
                boxOf({-5.0, 3.0, -5.0}, {5.0, 5.0, 5.0})});
    const std::vector densities{HUGE_VAL, 0.35};  // half of the rays get through 2 m
    std::vector<Sample> samples{{.world = {0.0, 0.0, 0.0}}, {.world = {30.0, 0.0, 0.0}}};
    weigh(samples, {.direction = {0.0, -1.0, 0.0}}, {.tree = tree, .density = densities});
    EXPECT_GT(samples[0].weight, 0.9);
    EXPECT_LT(samples[1].weight, 0.1);
    EXPECT_GT(samples[1].weight, 0.0);
}

}  // namespace
}  // namespace gnomon::shadow_fit
