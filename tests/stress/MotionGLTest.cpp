// What must stay as it is while the eye or a body moves.
#include <algorithm>
#include <cmath>

#include "Arena.h"

namespace gnomon::stress {
namespace {

using math::dmat4;
using math::dvec3;
using math::vec3;

class MotionGLTest : public Arena {
protected:
    scene::NodeWith<scene::MaterialGroup> field(const scene::Node& below) {
        const auto painted = paint(below, phong(vec3{0.8F}));
        add(painted.node, quad({-90.0F, 0.0F, 90.0F}, {180.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -180.0F}));
        for (int i = 0; i < 400; ++i) {
            const vec3 low{
                -40.0F + 4.0F * static_cast<float>(i % 20) + 0.13F * static_cast<float>(i % 7),
                0.0F,
                -40.0F + 4.0F * static_cast<float>(i / 20) + 0.21F * static_cast<float>(i % 5)};
            add(painted.node,
                box(low, low + vec3{0.7F, 1.0F + 0.4F * static_cast<float>(i % 4), 0.9F}), true);
        }
        return painted;
    }
};

/// Whether two maps have their texels at the same places of the world, be it whole texels on.
bool sameGrid(const dmat4& a, const dmat4& b, int mapSize) {
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column)
            if (a[column][row] != b[column][row]) return false;
        const double texels = (a[3][row] - b[3][row]) * 0.5 * mapSize;
        if (std::abs(texels - std::round(texels)) > 1e-6) return false;
    }
    for (int column = 0; column < 4; ++column)
        if (a[column].z != b[column].z) return false;
    return true;
}

// Stress case 16: the eye pans by a whole pixel at a time, half a texel, so that the picture
// but for its border is the same, moved. On the same texels the shadows move along with it exactly;
// others differ at their edges alone.
TEST_P(MotionGLTest, APanByLessThanATexelFlipsNoPixel) {
    const auto sun = light<scene::DirectionalLight>(root, {-2.0, 5.0, 1.0}, {0.0, 0.0, 0.0});
    field(sun.node);
    constexpr int size = 128;
    constexpr double pixel = 16.0 / size;
    const auto& camera = topView();
    const View eye = seen(camera, size, size, 64);
    const auto look = [&](int step) {
        const double x = step * pixel;
        edit(camera)->eyeFromWorld = math::lookAt({x, 20.0, 0.0}, {x, 0.0, 0.0}, {0.0, 0.0, -1.0});
        return both(eye, sun.node, true);
    };
    int kept = 0;
    int flips = 0;
    constexpr int steps = 12;
    auto before = look(0);
    auto maps = mapsOf(eye, sun.node);
    for (int step = 1; step <= steps; ++step) {
        auto now = look(step);
        const auto nowMaps = mapsOf(eye, sun.node);
        int differing = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x + 1 < size; ++x) {
                const auto at = static_cast<std::size_t>(y * size + x);
                const bool moved =
                    (now.factor.pixels[at] > 127) != (before.factor.pixels[at + 1] > 127);
                // What a soft filter does where it sees an edge is its own affair, if it is stable.
                differing += moved ? 1 : 0;
            }
        const bool same = maps.size() == nowMaps.size() &&
                          std::equal(maps.begin(), maps.end(), nowMaps.begin(),
                                     [&](const auto& a, const auto& b) {
                                         return sameGrid(a, b, stateOf(eye, sun.node)->mapSize);
                                     });
        kept += same ? 1 : 0;
        // Where maps have gone on, another one may be the first that holds a place.
        if (maps == nowMaps) {
            // A soft edge may cross the middle of grey by a last bit.
            EXPECT_LE(differing, GetParam().hard() ? 0 : 1) << "step " << step;
        }
        EXPECT_EQ(lostShadow(now.truth, now.factor, 1), 0) << "step " << step;
        EXPECT_EQ(falseShadow(now.truth, now.factor, 1), 0) << "step " << step;
        flips += differing;
        before = std::move(now);
        maps = nowMaps;
    }
    std::printf("%s: %d of %d steps on the same texels, %d flips\n", technique().c_str(), kept,
                steps, flips);
    if (GetParam().fit.stable) {
        EXPECT_GE(kept, steps / 2) << "it is seldom stable";
    }
}

// Stress case 17: while the eye turns, a stable fit's maps stay as they are, or go on by whole
// texels; a map whose size takes a step is an exception.
TEST_P(MotionGLTest, TurningTheEyeKeepsTheTexelsOfAStableMap) {
    if (!GetParam().fit.stable) GTEST_SKIP() << "its maps follow the view";
    const auto sun = light<scene::DirectionalLight>(root, {-2.0, 5.0, 1.0}, {0.0, 0.0, 0.0});
    field(sun.node);
    const auto& lens = perspectiveView({0.0, 3.0, 0.0}, {0.0, 0.0, -12.0});
    const View eye = seen(lens, 96, 72, 512);
    std::vector<dmat4> before;
    int kept = 0;
    int all = 0;
    for (int step = 0; step < 120; ++step) {
        const double angle = 0.001 * step;  // radians: 7 degrees in all
        place(*app.get(lens.beacon.get()), {0.0, 3.0, 0.0},
              {12.0 * std::sin(angle), 0.0, -12.0 * std::cos(angle)});
        update();
        const auto maps = mapsOf(eye, sun.node);
        ASSERT_FALSE(maps.empty());
        const int mapSize = stateOf(eye, sun.node)->mapSize;
        for (std::size_t i = 0; i < maps.size() && step > 0; ++i) {
            ++all;
            kept += i < before.size() && sameGrid(maps[i], before[i], mapSize) ? 1 : 0;
        }
        before = maps;
    }
    std::printf("%s: %d of %d maps on the same texels\n", technique().c_str(), kept, all);
    // Where the splits between maps move, two maps and more take a step at once.
    EXPECT_GT(kept, 0.8 * all);
}

// Stress case 27: after anything moved, the pages that were kept are those that would be drawn.
TEST_P(MotionGLTest, WhatIsKeptWhenABodyMovesIsWhatWouldBeDrawn) {
    const auto sun = light<scene::DirectionalLight>(root, {-2.0, 5.0, 1.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-8.0F, 0.0F, 8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
    add(painted.node, box({-5.0F, 0.0F, -5.0F}, {-4.0F, 3.0F, -4.0F}), true);
    add(painted.node, box({4.0F, 0.0F, 3.0F}, {5.0F, 2.0F, 4.0F}), true);
    const auto moved = transform(painted.node);
    add(moved.node, box({0.0F, 0.0F, 0.0F}, {0.8F, 1.5F, 0.8F}), true);
    const View eye = seen(perspectiveView({3.0, 9.0, 8.0}, {0.0, 0.0, 0.0}), 96, 96, 2048);
    for (int i = 0; i < 8; ++i) {
        edit(moved.core)->matrix =
            math::Affine{.translation = {-3.0 + 0.7 * i, 0.1 * i, 2.0 * std::sin(1.3 * i)}};
        const auto kept = factor(eye, sun.node);
        renderer->forgetShadows();
        const auto fresh = factor(eye, sun.node);
        EXPECT_EQ(kept, fresh) << "move " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(All, MotionGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::stress
