// Where one map ends and the next one begins, and where there are more pages than there is room
// for.
#include <cmath>

#include "Arena.h"

namespace gnomon::stress {
namespace {

using math::dvec3;
using math::vec3;

class CascadeGLTest : public Arena {};

// Stress case 18: a wall's shadow that runs from before the eye to the horizon, through every map
// there is. Its inside is dark and its outside lit without a gap; its edge has no step.
TEST_P(CascadeGLTest, AShadowThroughAllMapsHasNoGapAndNoStep) {
    const auto sun = light<scene::DirectionalLight>(root, {-4.0, 3.0, 0.3}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-300.0F, 0.0F, 300.0F}, {600.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -600.0F}));
    add(painted.node, box({-2.0F, 0.0F, -250.0F}, {-1.8F, 2.0F, 20.0F}), true);
    const auto& lens = perspectiveView({2.0, 2.5, 12.0}, {0.5, 0.0, 0.0});
    edit(lens)->far = 600.0;
    const View eye = seen(lens, 256, 192, 1024);
    // Along the way, so that the maps' borders pass over every pixel of it.
    for (int step = 0; step < 8; ++step) {
        const double z = 12.0 - 1.7 * step;
        place(*app.get(lens.beacon.get()), {2.0, 2.5, z}, {0.5, 0.0, z - 12.0});
        // A plain map's texels are a metre here. Where they see one thing alone, not one pixel may
        // be of the other; but for outlines, where the ray and the rasterizer may see two surfaces.
        const auto made = both(eye, sun.node, true);
        EXPECT_EQ(lostShadow(made.truth, made.factor, 1), 0) << "step " << step;
        EXPECT_EQ(falseShadow(made.truth, made.factor, 1), 0) << "step " << step;
        if (!GetParam().fit.sampled || !GetParam().hard()) continue;
        // Of fits that look at the picture, the coarser map's edge is within a pixel or two.
        const auto all = both(eye, sun.node);
        EXPECT_LE(all.error.edge95, 2.0) << "step " << step;
        std::size_t shadowed = 0;
        for (const std::uint8_t value : made.truth.pixels) shadowed += value == 0 ? 1U : 0U;
        EXPECT_GT(shadowed, 500U);
    }
}

// Stress case 26: more lights with large maps than there are pages. All of them are coarser; none
// is without its shadows.
TEST_P(CascadeGLTest, MorePagesThanThereAreMakesMapsCoarserAndNothingElse) {
    if (!GetParam().hard()) GTEST_SKIP() << "pages are no matter of the filter";
    if (sanitized) GTEST_SKIP() << "gigabytes of pages";
    constexpr int count = 17;  // of 256 pages each that were asked for
    std::vector<scene::Ref<scene::Node>> lights;
    const scene::Node* below = &root;
    for (int i = 0; i < count; ++i) {
        const double angle = 0.3 * i;
        const auto sun = light<scene::DirectionalLight>(
            *below, {3.0 * std::cos(angle), 4.0, 3.0 * std::sin(angle)}, {0.0, 0.0, 0.0});
        edit(sun.core)->intensity = 0.05F;
        lights.push_back(scene::Ref<scene::Node>{sun.node});
        below = &sun.node;
    }
    const auto painted = paint(*below, phong(vec3{0.8F}));
    add(painted.node, quad({-8.0F, 0.0F, 8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
    for (int i = 0; i < 81; ++i) {
        const vec3 low{-0.45F + 0.1F * static_cast<float>(i % 9), 0.03F,
                       -0.45F + 0.1F * static_cast<float>(i / 9)};
        add(painted.node, box(low, low + vec3{0.04F, 0.005F, 0.04F}), true);
    }
    // Shadows all over, which every map must hold.
    for (int i = 0; i < 4; ++i) {
        const vec3 low{i % 2 == 0 ? -7.0F : 6.0F, 0.5F, i / 2 == 0 ? -7.0F : 3.0F};
        add(painted.node, box(low, low + vec3{0.5F}), true);
    }
    // So small a part of the whole that it looks up a page or two of each map.
    const auto& tile = app.create<scene::TileDecorator>();
    {
        auto e = edit(tile);
        e->decoratee = perspectiveView({0.0, 6.0, 8.0}, {0.0, 0.0, 0.0});
        e->part = math::Rect{.left = 0.49, .bottom = 0.49, .width = 0.02, .height = 0.02};
    }
    const View eye = seen(tile, 64, 64, 16384);
    edit(eye.viewport)->cascades = 2;
    const scene::Node& last = *app.get(lights.back());
    const auto made = both(eye, last);
    EXPECT_FALSE(mapsOf(eye, last).empty());
    std::size_t shadowed = 0;
    for (const std::uint8_t value : made.truth.pixels) shadowed += value == 0 ? 1U : 0U;
    EXPECT_GT(shadowed, 50U);
    EXPECT_LE(lostShadow(made.truth, made.factor, 2), 4);
    EXPECT_LE(falseShadow(made.truth, made.factor, 2), 4);
}

INSTANTIATE_TEST_SUITE_P(All, CascadeGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::stress
