// Where shadow maps speckle: surfaces that graze the light, round bodies, things that touch.
#include <cmath>
#include <numbers>

#include "Arena.h"

namespace gnomon::stress {
namespace {

using math::dvec3;
using math::vec3;

class AcneGLTest : public Arena {};

// Stress case 12.
TEST_P(AcneGLTest, APlaneThatGrazesTheLightHasNone) {
    for (const double degrees : {0.1, 0.5, 2.0, 10.0}) {
        const double a = degrees * std::numbers::pi / 180.0;
        const auto sun = light<scene::DirectionalLight>(
            root, {-10.0 * std::cos(a), 10.0 * std::sin(a), 3.0 * std::cos(a)}, {0.0, 0.0, 0.0});
        const auto painted = paint(sun.node, phong(vec3{0.8F}));
        add(painted.node, quad({-30.0F, 0.0F, 30.0F}, {60.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -60.0F}));
        // So that there is something to cast at all.
        add(painted.node, box({3.0F, 0.0F, 0.0F}, {3.4F, 0.02F, 0.4F}), true);
        const auto& lens = perspectiveView({0.0, 2.0, 12.0}, {0.0, 0.0, 0.0});
        const View eye = seen(lens, 256, 256, 512);
        const auto factorImage = factor(eye, sun.node);
        std::size_t dark = 0;
        const auto shadow = truth(eye, sun.node);
        for (std::size_t i = 0; i < shadow.pixels.size(); ++i) {
            // Truth does not count what grazes this much; nothing but the box casts.
            const bool ground = factorImage.pixels[i] != truth::noSurface;
            dark += ground && factorImage.pixels[i] < 128 ? 1U : 0U;
        }
        // The box's own shadow, two centimetres high, at these angles up to some metres long.
        EXPECT_LT(dark, 1500U) << degrees << " degrees";
        edit(root)->removeChild(sun.node);
        ASSERT_TRUE(app.destroyTree(sun.node).has_value());
        ASSERT_TRUE(app.destroyTree(eye.window).has_value());
    }
}

// Stress case 15.
TEST_P(AcneGLTest, AClosedSphereHasNone) {
    const auto sun = light<scene::DirectionalLight>(root, {-3.0, 4.0, 5.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, sphere({0.0F, 1.5F, 0.0F}, 1.5F, 48), true);
    add(painted.node, quad({-8.0F, 0.0F, 8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
    const View eye = seen(perspectiveView({0.0, 2.0, 6.0}, {0.0, 1.2, 0.0}), 256, 256, 512);
    const auto made = both(eye, sun.node);
    // At its outline the mean of the depths is not that of any plane.
    EXPECT_LE(made.error.interior, GetParam().filter.bleeds ? 8U : 0U);
    EXPECT_LT(made.error.share(made.error.wrong), 0.01);
}

// The same, as if it were not known to be closed.
TEST_P(AcneGLTest, AnOpenSphereHasNone) {
    const auto sun = light<scene::DirectionalLight>(root, {-3.0, 4.0, 5.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, sphere({0.0F, 1.5F, 0.0F}, 1.5F, 48), false);
    add(painted.node, quad({-8.0F, 0.0F, 8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
    const View eye = seen(perspectiveView({0.0, 2.0, 6.0}, {0.0, 1.2, 0.0}), 256, 256, 512);
    const auto made = both(eye, sun.node);
    // At its outline the mean of the depths is not that of any plane.
    EXPECT_LE(made.error.interior, GetParam().filter.bleeds ? 8U : 0U);
    EXPECT_LT(made.error.share(made.error.wrong), 0.01);
}

// Stress case 13: the shadow of a plate a millimetre thick that lies on the ground begins at it.
TEST_P(AcneGLTest, AThinPlateOnTheGroundShadowsUpToItself) {
    const auto sun = light<scene::DirectionalLight>(root, {-4.0, 1.5, 0.5}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-4.0F, 0.0F, 4.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -8.0F}));
    // A wall a millimetre thick, standing on the ground: contact along a line.
    add(painted.node, box({0.0F, 0.0F, -1.0F}, {0.001F, 1.0F, 1.0F}), true);
    const View eye = seen(perspectiveView({3.0, 2.5, 0.0}, {0.5, 0.0, 0.0}), 256, 256, 512);
    const auto made = both(eye, sun.node);
    EXPECT_EQ(lostShadow(made.truth, made.factor, 2), 0);
    EXPECT_LT(made.error.share(made.error.falseLight), 0.004);
}

INSTANTIATE_TEST_SUITE_P(All, AcneGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::stress
