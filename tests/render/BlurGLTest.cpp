// Factors blurred on the screen: as wide as a Gaussian in the world, whatever the surface is seen
// at, and no wider than the surface.
#include <gnomon/scene/CameraView.h>

#include <cmath>
#include <numbers>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::vec3;

class BlurGLTest : public RenderTest {
protected:
    static constexpr int size = 384;

    View blurred(const scene::Camera& camera, const std::string& fit, double softness,
                 int mapSize = 2048) {
        const View made = view(camera, size, size);
        auto e = edit(made.viewport);
        e->technique = fit + "+gauss";
        e->mapSize = fit == "csm" ? 2 * mapSize : mapSize;  // shared out among its maps
        e->softness = static_cast<float>(softness);
        e->qualityMode = true;
        return made;
    }
    /// Where a pixel's ray meets the plane y = slope * x.
    static dvec3 onPlane(const math::View& view, int x, int y, double slope) {
        const math::dmat4 worldFromClip = glm::inverse(view.clipFromWorld());
        const auto at = [&](double depth) {
            const math::dvec4 p =
                worldFromClip *
                math::dvec4{(x + 0.5) / size * 2.0 - 1.0, 1.0 - (y + 0.5) / size * 2.0, depth, 1.0};
            return dvec3{p} / p.w;
        };
        const dvec3 near = at(1.0);
        const dvec3 way = at(1e-3) - near;
        const dvec3 normal{-slope, 1.0, 0.0};
        return near - way * (glm::dot(normal, near) / glm::dot(normal, way));
    }
    static double normalShare(double deviations) {
        return 0.5 * std::erfc(-deviations / std::numbers::sqrt2);
    }
    math::View viewOf(const View& view) const {
        return orThrow(scene::cameraView(server, copyOf(view.viewport).camera, 1.0)).view;
    }
};

/// How a straight edge, the receiver and the eye lie.
struct EdgeCase {
    const char* name = "";
    double azimuth = 0.0;  ///< of the edge, degrees from the world's x axis
    double slope = 0.0;    ///< of the receiver: y = slope * x
    bool fromAbove = true;
    dvec3 toSun{-5.0, 5.0, 0.0};
};
constexpr double degree = std::numbers::pi / 180.0;

class EdgeBlurGLTest : public BlurGLTest,
                       public testing::WithParamInterface<std::tuple<EdgeCase, const char*>> {};

// The part of a round Gaussian, across the rays, that is on one side of the plane through the edge
// and the light.
TEST_P(EdgeBlurGLTest, AnEdgeOnAPlaneIsTheErrorFunction) {
    const auto& [at, fit] = GetParam();
    const double softness = 0.3;
    const dvec3 along{std::cos(at.azimuth * degree), 0.0, std::sin(at.azimuth * degree)};
    const dvec3 aside{-along.z, 0.0, along.x};  // horizontal; the caster is on this side
    const auto sun = light<scene::DirectionalLight>(root, at.toSun, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    const auto slope = static_cast<float>(at.slope);
    add(painted.node,
        quad({-9.0F, -9.0F * slope, 9.0F}, {18.0F, 18.0F * slope, 0.0F}, {0.0F, 0.0F, -18.0F}));
    // The edge's shadow passes through the middle; the caster hides nothing from the eye.
    const double up = 30.0;
    const dvec3 edge = at.toSun * (up / at.toSun.y);
    const dvec3 end = edge - along * 60.0;
    add(painted.node, quad(vec3{end}, vec3{along * 120.0}, vec3{aside * 60.0}));
    const View eye = blurred(at.fromAbove ? static_cast<const scene::Camera&>(topView())
                                          : perspectiveView({2.0, 4.0, 9.0}, {0.0, 0.0, 0.0}),
                             fit, softness);
    const image::Image found = factor(eye, sun.node);
    const math::View lens = viewOf(eye);
    dvec3 across = glm::normalize(glm::cross(along, at.toSun));
    if (glm::dot(across, aside) > 0.0) across = -across;  // toward what is lit
    // A kernel is cut off at 2.5 deviations: 0.6 % on either side; an edge in the map is a texel
    // wide.
    constexpr double tolerance = 0.04;
    int compared = 0;
    int between = 0;
    double worst = 0.0;
    dvec3 where{0.0};
    int wrong = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const dvec3 place = onPlane(lens, x, y, at.slope);
            if (std::max(std::abs(place.x), std::abs(place.z)) > 5.0) continue;
            const double beside = glm::dot(place, across);
            const double right = normalShare(beside / (0.5 * softness));
            const double value = pixel(found, x, y)[0] / 255.0;
            if (std::abs(value - right) > worst) {
                worst = std::abs(value - right);
                where = place;
            }
            wrong += std::abs(value - right) > tolerance ? 1 : 0;
            ++compared;
            between += right > 0.1 && right < 0.9 ? 1 : 0;
        }
    }
    EXPECT_LE(worst, tolerance) << wrong << " pixels of " << compared << " are off, the most at "
                                << where.x << ", " << where.z;
    EXPECT_GT(compared, 5000);
    EXPECT_GT(between, 1000);
}

// Kernels at the sides of the view read what lies beyond it, where cascades, whose sides have
// lengths of their own, end.
TEST_F(BlurGLTest, DeepInAShadowNothingIsLitUpToTheSidesOfTheView) {
    const auto sun = light<scene::DirectionalLight>(root, {-5.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F}));
    add(painted.node, quad({-30.0F, 30.0F, -60.0F}, {0.0F, 0.0F, 120.0F}, {-60.0F, 0.0F, 0.0F}));
    const View eye = blurred(perspectiveView({2.0, 4.0, 9.0}, {0.0, 0.0, 0.0}), "csm", 0.3);
    for (const char* filter : {"pcf", "rotated", "hardware", "ppcf", "gauss"}) {
        edit(eye.viewport)->technique = std::string{"csm+"} + filter;
        const image::Image found = factor(eye, sun.node);
        const math::View lens = viewOf(eye);
        int lit = 0;
        int judged = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const dvec3 place = onPlane(lens, x, y, 0.0);
                if (std::max(std::abs(place.x), std::abs(place.z)) > 8.5 || place.x > -0.5)
                    continue;
                ++judged;
                lit += pixel(found, x, y)[0] > 2 ? 1 : 0;
            }
        }
        EXPECT_EQ(lit, 0) << filter << ", of " << judged;
        EXPECT_GT(judged, 5000);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, EdgeBlurGLTest,
    testing::Combine(
        testing::Values(EdgeCase{.name = "across", .azimuth = 90.0},
                        EdgeCase{.name = "slanting", .azimuth = 60.0},
                        EdgeCase{.name = "diagonal", .azimuth = 135.0, .toSun = {-3.0, 5.0, 1.0}},
                        EdgeCase{.name = "inPerspective", .azimuth = 90.0, .fromAbove = false},
                        EdgeCase{.name = "onASlope",
                                 .azimuth = 70.0,
                                 .slope = 0.6,
                                 .fromAbove = false,
                                 .toSun = {-3.0, 6.0, 2.0}},
                        EdgeCase{.name = "awayOnASlope",
                                 .azimuth = 20.0,
                                 .slope = -0.4,
                                 .fromAbove = false,
                                 .toSun = {1.0, 5.0, 3.0}}),
        testing::Values("std", "lispsm", "csm")),
    [](const auto& info) {
        return std::string{std::get<0>(info.param).name} + "_" + std::get<1>(info.param);
    });

// What the thesis' filter does: a halo around what is lit before what is not.
TEST_F(BlurGLTest, WhatIsLitBeforeAShadowHasNoGlowAndKeepsItsLight) {
    const auto sun = light<scene::DirectionalLight>(root, {-5.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F}));
    // A roof over x < -3: dark is the ground up to x = 1, and at 3 m up to x = -2.
    add(painted.node, quad({-12.0F, 4.0F, 40.0F}, {9.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -80.0F}));
    add(painted.node, quad({-1.0F, 3.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F}));
    const View eye = blurred(topView(), "std", 0.4);
    const auto found = factor(eye, sun.node);
    int plate = 0;
    int ground = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double wx = (x + 0.5) / size * 16.0 - 8.0;
            const double wz = (y + 0.5) / size * 16.0 - 8.0;
            // The ground's own edge begins at 1 - 2.5 deviations.
            if (wx < -2.5 || wx > 0.2 || std::abs(wz) > 3.0) continue;
            const bool onPlate = wx > -1.0 && wx < 0.0 && std::abs(wz) < 1.0;
            (onPlate ? plate : ground) += 1;
            ASSERT_EQ(pixel(found, x, y)[0], onPlate ? 255 : 0) << wx << ", " << wz;
        }
    }
    EXPECT_GT(plate, 1000);
    EXPECT_GT(ground, 1000);
}

// A box's top is lit up to its edges: neither what faces away nor its dark sides bleed into it.
TEST_F(BlurGLTest, WhatFacesAwayDoesNotBleed) {
    const auto sun = light<scene::DirectionalLight>(root, {-3.0, 5.0, -4.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F}));
    add(painted.node, box({-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}), true);
    const View eye = blurred(perspectiveView({3.0, 6.0, 7.0}, {0.0, 1.0, 0.0}), "std", 0.4);
    const auto found = factor(eye, sun.node);
    const math::dmat4 clip = viewOf(eye).clipFromWorld();
    const auto at = [&](const dvec3& world) {
        const math::dvec4 p = clip * math::dvec4{world, 1.0};
        return pixel(found, static_cast<int>((p.x / p.w * 0.5 + 0.5) * size),
                     static_cast<int>((0.5 - p.y / p.w * 0.5) * size))[0];
    };
    for (double s = -1.4; s <= 1.4; s += 0.05) {
        for (const double inward : {0.05, 0.1, 0.2}) {
            EXPECT_EQ(at({s, 2.0, 1.5 - inward}), 255) << s;
            EXPECT_EQ(at({1.5 - inward, 2.0, s}), 255) << s;
        }
        EXPECT_EQ(at({s, 1.9, 1.5}), 0) << s;
        EXPECT_EQ(at({1.5, 1.9, s}), 0) << s;
    }
}

TEST_F(BlurGLTest, NothingIsBlurredAgainWhileNothingChanges) {
    const auto sun = light<scene::DirectionalLight>(root, {-5.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F}));
    const auto moved = transform(painted.node);
    add(moved.node, box({-1.0F, 1.0F, -1.0F}, {1.0F, 2.0F, 1.0F}), true);
    const View eye = blurred(topView(), "std", 0.2, 512);
    const auto first = draw(eye);
    EXPECT_EQ(first.kernelPixels, 60);
    EXPECT_EQ(first.factorPixels, std::uint64_t{size + 128} * (size + 128));
    EXPECT_GT(first.factorBytes, 0U);
    const auto before = renderer->read(copyOf(eye.window));
    const auto second = draw(eye);
    EXPECT_EQ(second.factorPixels, 0U);
    EXPECT_EQ(second.shadowTriangles, 0U);
    EXPECT_EQ(renderer->read(copyOf(eye.window)), before);
    renderer->forgetShadows();
    EXPECT_EQ(draw(eye).factorPixels, first.factorPixels);
    EXPECT_EQ(renderer->read(copyOf(eye.window)), before);
    edit(moved.core)->matrix = math::Affine{.translation = {0.5, 0.0, 0.0}};
    EXPECT_EQ(draw(eye).factorPixels, first.factorPixels);
    EXPECT_NE(renderer->read(copyOf(eye.window)), before);
}

// More than one pass over the scene finds the factors of.
TEST_F(BlurGLTest, SevenSunsAreAsOne) {
    const auto pictureWith = [&](int suns) {
        const scene::Node* below = &root;
        const scene::Node* first = nullptr;
        for (int i = 0; i < suns; ++i) {
            const auto sun =
                light<scene::DirectionalLight>(*below, {-5.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
            edit(sun.core)->intensity = 1.0F / static_cast<float>(suns);
            below = &sun.node;
            if (first == nullptr) first = below;
        }
        const auto painted = paint(*below, phong(vec3{0.6F}));
        add(painted.node, quad({-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F}));
        add(painted.node, box({-1.0F, 1.0F, -1.0F}, {1.0F, 2.0F, 1.0F}), true);
        const View eye = blurred(topView(), "std", 0.3, 512);
        const auto made = picture(eye);
        edit(root)->removeChild(*first);
        EXPECT_TRUE(app.destroyTree(*first).has_value());
        EXPECT_TRUE(app.destroyTree(eye.window).has_value());
        return made;
    };
    const auto one = pictureWith(1);
    const auto seven = pictureWith(7);
    const auto difference = image::compare(one, seven, 1);
    ASSERT_TRUE(difference.has_value());
    EXPECT_EQ(difference->share, 0.0) << "largest " << difference->largest;
}

}  // namespace
}  // namespace gnomon::render
