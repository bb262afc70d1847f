// Where maps with a perspective of their own turn over, lose precision or lose casters.
#include <cmath>
#include <numbers>

#include "Arena.h"

namespace gnomon::stress {
namespace {

using math::dvec3;
using math::vec3;

class WarpGLTest : public Arena {
protected:
    /// Posts in rows, away from the eye, on a ground.
    void posts(const scene::Node& below) {
        add(below, quad({-30.0F, 0.0F, 30.0F}, {60.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -60.0F}));
        for (int i = 0; i < 12; ++i) {
            const vec3 low{-6.0F + 4.0F * static_cast<float>(i % 4), 0.0F,
                           2.0F - 8.0F * static_cast<float>(i / 4)};
            add(below, box(low, low + vec3{0.8F, 3.0F, 0.8F}), true);
        }
    }
};

// Stress case 3: what is seen is all at about one distance, so that n = d / (sqrt(z1 / z0) - 1) is
// a large number by the reciprocal of a small one.
TEST_P(WarpGLTest, AllAtOneDistanceIsNoWorseThanThePlainMap) {
    const auto sun = light<scene::DirectionalLight>(root, {-3.0, 4.0, 5.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    // A wall that faces the eye, and plates just before it.
    add(painted.node, quad({-5.0F, -5.0F, 0.0F}, {10.0F, 0.0F, 0.0F}, {0.0F, 10.0F, 0.0F}));
    for (int i = 0; i < 9; ++i) {
        const vec3 low{-4.0F + 3.0F * static_cast<float>(i % 3),
                       -4.0F + 3.0F * static_cast<float>(i / 3), 0.4F};
        add(painted.node, box(low, low + vec3{1.2F, 1.5F, 0.05F}), true);
    }
    for (const double distance : {10.0, 1e3, 1e5, 1e6}) {
        const auto& lens = perspectiveView({0.0, 0.0, distance}, {0.0, 0.0, 0.0});
        {
            auto e = edit(lens);
            e->fovy = 2.0 * std::atan(4.5 / distance);
            e->near = distance - 5.0;
            e->far = distance + 5.0;
        }
        const View eye = seen(lens, 192, 192, 256);
        edit(eye.viewport)->technique = plain();
        const auto uniform = both(eye, sun.node);
        edit(eye.viewport)->technique = technique();
        const auto made = both(eye, sun.node);
        // Several maps, of which slices of the view's depth make no use here, have wider texels.
        const double wider = 256.0 / stateOf(eye, sun.node)->mapSize;
        EXPECT_LE(made.error.share(made.error.wrong),
                  (1.3 * uniform.error.share(uniform.error.wrong) + 0.004) * wider)
            << distance << " m";
        EXPECT_LE(lostShadow(made.truth, made.factor, 3), 4) << distance << " m";
        EXPECT_LE(falseShadow(made.truth, made.factor, 3), 4) << distance << " m";
        EXPECT_TRUE(app.destroyTree(eye.window).has_value());
    }
}

// Stress case 4: a focus that ends at nothing, at the pole of the 80 % rule and beyond it.
TEST_P(WarpGLTest, NoFocusRegionTurnsTheMapOver) {
    const auto sun = light<scene::DirectionalLight>(root, {-6.0, 5.0, 1.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.7F}));
    posts(painted.node);
    const View eye = seen(perspectiveView({0.0, 4.0, 12.0}, {0.0, 1.0, 0.0}), 160, 120, 512);
    for (const double range :
         {0.0, 1e-12, 0.05, 0.6, 0.79, 0.8 - 1e-7, 0.8, 0.8 + 1e-7, 0.81, 1.0}) {
        edit(eye.viewport)->range = static_cast<float>(range);
        const auto made = both(eye, sun.node);
        EXPECT_LE(lostShadow(made.truth, made.factor, 3), 4) << range;
        EXPECT_LE(falseShadow(made.truth, made.factor, 3), 4) << range;
        EXPECT_LT(made.error.share(made.error.wrong), 0.03) << range;
    }
}

// Stress case 5: the light and what casts are behind the eye.
TEST_P(WarpGLTest, CastersBehindTheEyeKeepTheirShadows) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 5.0, 0.0}, {0.0, 0.0, 0.1});
    const auto spot = light<scene::SpotLight>(sun.node, {0.0, 9.0, 0.0}, {0.0, 0.0, 0.1});
    edit(spot.core)->outerAngle = 0.6F;
    const auto painted = paint(spot.node, phong(vec3{0.7F}));
    posts(painted.node);
    for (int i = 0; i < 5; ++i) {
        const vec3 low{-9.0F + 4.0F * static_cast<float>(i), 0.0F, 13.0F};
        add(painted.node, box(low, low + vec3{1.5F, 9.0F, 0.5F}), true);
    }
    const View eye = seen(perspectiveView({0.0, 3.0, 10.0}, {0.0, 0.0, -4.0}), 160, 120, 512);
    int shadowed = 0;
    for (const double elevation : {10.0, 25.0, 50.0}) {
        for (const double azimuth : {-60.0, 0.0, 20.0}) {
            const double up = elevation * std::numbers::pi / 180.0;
            const double aside = azimuth * std::numbers::pi / 180.0;
            const dvec3 toward{std::cos(up) * std::sin(aside), std::sin(up),
                               std::cos(up) * std::cos(aside)};
            place(*app.get(sun.core.beacon.get()), toward * 5.0, dvec3{0.0});
            place(*app.get(spot.core.beacon.get()), toward * 30.0, dvec3{0.0});
            for (const scene::Node* light : {&sun.node, &spot.node}) {
                const auto made = both(eye, *light);
                EXPECT_LE(lostShadow(made.truth, made.factor, 3), 4)
                    << elevation << ", " << azimuth << " degrees";
                EXPECT_LE(falseShadow(made.truth, made.factor, 3), 4)
                    << elevation << ", " << azimuth << " degrees";
                for (const std::uint8_t value : made.truth.pixels) shadowed += value == 0 ? 1 : 0;
            }
        }
    }
    // What bleeds is judged by its light alone, and edges of texels hide much of the rest.
    if (GetParam().hard()) {
        EXPECT_GT(shadowed, 5000);
    }
}

// Stress case 8: what is seen of a body are neither its corners nor the view volume's, but where
// edges of one pass through faces of the other.
TEST_P(WarpGLTest, WhatPassesThroughTheViewWithoutACornerInItKeepsItsShadows) {
    const auto sun = light<scene::DirectionalLight>(root, {-2.0, 5.0, 3.0}, {0.0, 0.0, 0.0});
    const auto turned = transform(sun.node);
    const auto painted = paint(turned.node, phong(vec3{0.8F}));
    // A beam far longer than the view is wide, and a rail along it that casts on it.
    add(painted.node, box({-60.0F, -0.5F, -0.5F}, {60.0F, 0.5F, 0.5F}), true);
    add(painted.node, box({-60.0F, 1.0F, 0.1F}, {60.0F, 1.2F, 0.3F}), true);
    const View eye = seen(perspectiveView({0.0, 3.0, 9.0}, {0.0, 0.0, 0.0}), 160, 120, 512);
    int shadowed = 0;
    for (int i = 0; i < 12; ++i) {
        const double angle = i * std::numbers::pi / 12.0;
        const dvec3 along =
            glm::normalize(dvec3{std::cos(angle), 0.3 * std::sin(3.0 * angle), std::sin(angle)});
        const dvec3 up = glm::normalize(dvec3{0.0, 1.0, 0.0} - along * along.y);
        math::dmat4 matrix{1.0};
        matrix[0] = math::dvec4{along, 0.0};
        matrix[1] = math::dvec4{up, 0.0};
        matrix[2] = math::dvec4{glm::cross(along, up), 0.0};
        edit(turned.core)->matrix = math::toAffine(matrix);
        const auto made = both(eye, sun.node);
        EXPECT_LE(lostShadow(made.truth, made.factor, 3), 4) << "turn " << i;
        EXPECT_LE(falseShadow(made.truth, made.factor, 3), 12) << "turn " << i;
        for (const std::uint8_t value : made.truth.pixels) shadowed += value == 0 ? 1 : 0;
    }
    if (GetParam().hard()) {
        EXPECT_GT(shadowed, 1000);
    }
}

INSTANTIATE_TEST_SUITE_P(All, WarpGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::stress
