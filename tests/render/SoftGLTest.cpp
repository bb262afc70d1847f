// Penumbrae where closed formulas say they are, and as smooth.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;

/// A straight edge 4 m above a plane, under a sun at 45 degrees: the edge's shadow is at x = 1.
class SoftGLTest : public RenderTest, public testing::WithParamInterface<const char*> {
protected:
    static constexpr double height = 4.0;
    static constexpr double edge = -3.0;
    static constexpr int size = 512;  // pixels of 1/32 m

    /// The middle row of the factor image, 0 to 1.
    std::vector<double> row(const std::string& technique, double angle, double softness = 0.0) {
        const auto sun = light<scene::DirectionalLight>(root, {-5.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
        edit(sun.core)->angle = static_cast<float>(angle);
        const auto painted = paint(sun.node, phong(math::vec3{0.8F}));
        add(painted.node, quad({-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F}));
        const auto y = static_cast<float>(height);
        add(painted.node, quad({-9.0F, y, 40.0F}, {6.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -80.0F}));
        const View eye = view(topView(), size, size);
        {
            auto e = edit(eye.viewport);
            e->technique = technique;
            e->mapSize = technique.starts_with("csm") ? 4096 : 2048;  // shared out among its maps
            e->softness = static_cast<float>(softness);
            e->qualityMode = true;
        }
        const image::Image found = factor(eye, sun.node);
        std::vector<double> values;
        for (int x = 0; x < size; ++x) values.push_back(pixel(found, x, size / 2)[0] / 255.0);
        return values;
    }
    static double placeOf(std::size_t x) { return (static_cast<double>(x) + 0.5) / 32.0 - 8.0; }
    /// The share of a disk on one side of a line, @p t radii from its middle.
    static double shareOfDisk(double t) {
        const double u = std::clamp(t, -1.0, 1.0);
        return 0.5 + (u * std::sqrt(1.0 - u * u) + std::asin(u)) / std::numbers::pi;
    }
    /// How far the edge is beside the sun's middle, seen from a place, in radii of the sun.
    static double besideSun(double place, double angle) {
        return std::sin(std::atan2(height, place - edge) - std::numbers::pi / 4.0) /
               std::sin(angle);
    }
    /// From half a metre beside the slab's own edge to where nothing changes any more.
    /// @param off  from the formula, at most
    /// @param step  more than the formula's from a pixel to the next, at most: two steps of a byte,
    ///              and half of one that bytes make of the difference
    template <class Formula>
    static void expect(const std::vector<double>& found, Formula formula, double off = 0.03,
                       double step = 2.5 / 255.0) {
        for (std::size_t x = 1; x < found.size(); ++x) {
            const double place = placeOf(x);
            if (place < -2.5 || place > 4.0) continue;
            const double right = formula(place);
            EXPECT_NEAR(found[x], right, off) << "at " << place << " m";
            const double own = std::abs(right - formula(placeOf(x - 1)));
            EXPECT_LE(std::abs(found[x] - found[x - 1]), own + step)
                << "a band at " << place << " m";
        }
    }
};

TEST_P(SoftGLTest, TheSunsPenumbraIsAsWideAsItsDiskAndWithoutBands) {
    const double angle = 2.0 * std::numbers::pi / 180.0;
    const auto found = row(std::string{GetParam()} + "+ppcf", angle);
    expect(found, [&](double x) { return shareOfDisk(-besideSun(x, angle)); });
}

TEST_P(SoftGLTest, WhatIsLowInAWidePenumbraHidesNoMoreThanItsOwn) {
    // A kerb along the row's direction, lower than a pixel is wide: its own shadow falls along it.
    add(root, quad({-9.0F, 0.02F, -0.1F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -0.5F}));
    const double angle = 2.0 * std::numbers::pi / 180.0;
    const auto found = row(std::string{GetParam()} + "+ppcf", angle);
    for (std::size_t x = 0; x < found.size(); ++x) {
        const double place = placeOf(x);
        if (place < -2.5 || place > 4.0) continue;
        EXPECT_NEAR(found[x], shareOfDisk(-besideSun(place, angle)), 0.06)
            << "at " << place << " m";
    }
}

TEST_P(SoftGLTest, WhatIsAtTwoHeightsHidesWhatEitherHides) {
    // A board along the row's direction, a fourth as high as the slab, as seen from the row hides
    // all of the light that is further than 0.4 radii to its side.
    const double angle = 2.0 * std::numbers::pi / 180.0;
    const double radius = std::numbers::sqrt2 * std::tan(angle);  // of the light, at the board
    const auto beside = static_cast<float>(0.5 / 32.0 - 0.4 * radius);
    add(root, quad({-9.0F, 1.0F, beside}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -3.0F}));
    const auto found = row(std::string{GetParam()} + "+ppcf", angle);
    for (std::size_t x = 0; x < found.size(); ++x) {
        const double place = placeOf(x);
        if (place < -2.5 || place > 4.0) continue;
        // What neither hides, in strips of the disk.
        const double least = std::clamp(besideSun(place, angle), -1.0, 1.0);
        // A map knows nothing of the board behind the slab; and what of the slab is at the rim
        // alone may be missed, where something else was found.
        if (least > -0.25 || (least > -0.999 && least < -0.65)) continue;
        constexpr int strips = 1000;
        double area = 0.0;
        for (int i = 0; i < strips; ++i) {
            const double u = least + (1.0 - least) * (i + 0.5) / strips;
            const double chord = std::sqrt(1.0 - u * u);
            area += (1.0 - least) / strips * std::max(chord + std::min(chord, 0.4), 0.0);
        }
        EXPECT_NEAR(found[x], area / std::numbers::pi, 0.06) << "at " << place << " m";
    }
}

TEST_P(SoftGLTest, AKernelOfMetresIsAsWideInEveryMapAndWithoutBands) {
    const double softness = 0.2;
    const auto found = row(std::string{GetParam()} + "+pcf", 0.0, softness);
    expect(found, [&](double x) { return shareOfDisk((x - 1.0) * std::sqrt(0.5) / softness); });
}

TEST_P(SoftGLTest, WithoutAnExtentItIsTheHardShadow) {
    EXPECT_EQ(row(std::string{GetParam()} + "+ppcf", 0.0), row(GetParam(), 0.0));
}

TEST_P(SoftGLTest, MomentsAreDarkLitAndRiseBetween) {
    for (const char* filter : {"+vsm", "+evsm"}) {
        const auto found = row(GetParam() + std::string{filter}, 0.0, 0.2);
        for (std::size_t x = 1; x < found.size(); ++x) {
            const double place = placeOf(x);
            if (place < -2.0 || place > 4.0) continue;
            if (place < 0.2) {
                EXPECT_LE(found[x], 0.02) << filter << " at " << place;
            }
            if (place > 1.8) {
                EXPECT_GE(found[x], 0.98) << filter << " at " << place;
            }
            EXPECT_GE(found[x], found[x - 1] - 2.0 / 255.0) << filter << " at " << place;
            EXPECT_LE(found[x], found[x - 1] + 0.2) << filter << " at " << place;
        }
    }
}

/// What technique `ray` finds, without a map.
class RaySoftGLTest : public SoftGLTest {};

TEST_F(RaySoftGLTest, TheSunsPenumbraIsAsWideAsItsDiskAndWithoutBands) {
    const double angle = 2.0 * std::numbers::pi / 180.0;
    const auto formula = [&](double x) { return shareOfDisk(-besideSun(x, angle)); };
    // 64 rays know a share no better than their places do (Sunflower's test), in steps of a ray.
    expect(row("ray", angle), formula, 0.05, 3.0 / 64.0);
}

TEST_F(RaySoftGLTest, WhatIsThinnerThanItsPenumbraDarkensByItsWidth) {
    // A bar across the row, which a sixth of the rays to a pixel below it meet at most.
    constexpr float width = 0.05F;
    add(root,
        quad({0.0F, static_cast<float>(height), 40.0F}, {width, 0.0F, 0.0F}, {0.0F, 0.0F, -80.0F}));
    const auto found = row("ray", 2.0 * std::numbers::pi / 180.0);
    double dark = 0.0;
    double darkest = 1.0;
    for (std::size_t x = 0; x < found.size(); ++x) {
        if (placeOf(x) < 3.0 || placeOf(x) > 5.0) continue;
        dark += (1.0 - found[x]) / 32.0;
        darkest = std::min(darkest, found[x]);
    }
    EXPECT_NEAR(dark, width, 0.1 * width) << "as if every part of the sun cast a shadow as wide";
    EXPECT_GT(darkest, 0.8);
}

class StretchedGLTest : public RenderTest, public testing::WithParamInterface<const char*> {};

// A strip of ground, five times as long as it is wide, has a map whose texels are; a kernel is a
// disk all the same.
TEST_P(StretchedGLTest, MomentsAreAsSoftBothWays) {
    const auto sun = light<scene::DirectionalLight>(root, {-5.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(math::vec3{0.8F}));
    add(painted.node, quad({-8.0F, 0.0F, 1.6F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -3.2F}));
    // Its shadow, at [-2, 2] x [-0.7, 0.7], lies half beside it.
    add(painted.node, quad({-4.0F, 2.0F, 0.7F}, {4.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.4F}));
    const View eye = view(topView(), 512, 512);
    {
        auto e = edit(eye.viewport);
        e->technique = std::string{"std+"} + GetParam();
        e->mapSize = 1024;
        e->softness = 0.2F;
    }
    const image::Image found = factor(eye, sun.node);
    const auto soft = [](int value) { return value > 25 && value < 230; };
    int along = 0;
    int across = 0;
    for (int x = 288; x < 400; ++x) along += soft(pixel(found, x, 256)[0]) ? 1 : 0;
    for (int y = 256; y < 300; ++y) across += soft(pixel(found, 284, y)[0]) ? 1 : 0;
    ASSERT_GT(across, 2);
    // Where the rays slant the kernel is longer on the ground.
    EXPECT_NEAR(along, std::numbers::sqrt2 * across, 0.3 * along);
}

INSTANTIATE_TEST_SUITE_P(All, StretchedGLTest, testing::Values("vsm", "evsm", "vsm16", "evsm16"),
                         [](const auto& info) { return std::string{info.param}; });

INSTANTIATE_TEST_SUITE_P(All, SoftGLTest, testing::Values("std", "trapez", "psm", "lispsm", "csm"),
                         [](const auto& info) { return std::string{info.param}; });

}  // namespace
}  // namespace gnomon::render
