// Shadows where geometry says they are.
#include <cmath>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::vec3;

/// A ground of 20 m and a box of 2 m on it, under one light.
class ShadowGLTest : public RenderTest {
protected:
    static constexpr double margin = 0.15;  // metres around an edge that are not judged

    void stage(const scene::Node& below) {
        const auto ground = paint(below, phong(vec3{0.8F}));
        add(ground.node, quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
        add(ground.node, box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 2.0F, 1.0F}), true);
    }
    const math::Box caster{.min = {-1.0, 0.0, -1.0}, .max = {1.0, 2.0, 1.0}};

    /// Compares a factor image of the top view with the ray from each ground point.
    /// @param wayToLight  not normalised; the light is at its end where reach is 1
    template <class Way>
    void expectAnalytic(const image::Image& found, Way wayToLight, double reach,
                        double halfAngle = 10.0, dvec3 axis = {0.0, -1.0, 0.0}) {
        ASSERT_EQ(found.channels, 1);
        int litPixels = 0;
        int darkPixels = 0;
        int wrong = 0;
        for (int y = 0; y < found.height; ++y) {
            for (int x = 0; x < found.width; ++x) {
                const dvec3 p{(x + 0.5) / found.width * 16.0 - 8.0, 0.0,
                              (y + 0.5) / found.height * 16.0 - 8.0};
                const double side = std::max(std::abs(p.x), std::abs(p.z));
                if (std::abs(side - 1.0) < margin) continue;
                if (side < 1.0) {  // the box's own top, which nothing shadows
                    wrong += pixel(found, x, y)[0] != 255 ? 1 : 0;
                    continue;
                }
                const dvec3 way = wayToLight(p);
                if (std::acos(glm::dot(glm::normalize(-way), axis)) > halfAngle * 0.95) continue;
                const bool dark = blocks(caster, p, way, reach);
                bool edge = false;
                for (const double dx : {-margin, 0.0, margin})
                    for (const double dz : {-margin, 0.0, margin}) {
                        const dvec3 q = p + dvec3{dx, 0.0, dz};
                        edge = edge || blocks(caster, q, wayToLight(q), reach) != dark;
                    }
                if (edge) continue;
                (dark ? darkPixels : litPixels) += 1;
                const bool bad = pixel(found, x, y)[0] != (dark ? 0 : 255);
                if (bad && wrong++ == 0)
                    ADD_FAILURE() << "at " << p.x << ", " << p.z << " the factor is "
                                  << pixel(found, x, y)[0] << ", dark: " << dark;
            }
        }
        EXPECT_GT(litPixels, 1000);
        EXPECT_GT(darkPixels, 100);
        EXPECT_EQ(wrong, 0);
    }
};

TEST_F(ShadowGLTest, ASunsShadowLiesWhereGeometrySays) {
    for (const dvec3& direction :
         {dvec3{1.0, -2.0, 0.0}, dvec3{-1.0, -1.0, 0.7}, dvec3{0.3, -0.6, -1.0}}) {
        SCOPED_TRACE(direction.x);
        const auto sun = light<scene::DirectionalLight>(root, -direction, {0.0, 0.0, 0.0});
        stage(sun.node);
        const View top = view(topView(), 256, 256);
        expectAnalytic(
            factor(top, sun.node), [&](const dvec3&) { return -direction; }, 100.0);
        edit(root)->removeChild(sun.node);
        ASSERT_TRUE(app.destroyTree(sun.node).has_value());
        ASSERT_TRUE(app.destroyTree(top.window).has_value());
    }
}

TEST_F(ShadowGLTest, ASpotsShadowLiesWhereGeometrySays) {
    const dvec3 position{-4.0, 6.0, 2.0};
    const dvec3 target{0.5, 0.0, 0.0};
    const auto spot = light<scene::SpotLight>(root, position, target);
    edit(spot.core)->outerAngle = 0.6F;
    stage(spot.node);
    const View top = view(topView(), 256, 256);
    expectAnalytic(
        factor(top, spot.node), [&](const dvec3& p) { return position - p; }, 1.0, 0.6,
        glm::normalize(target - position));
}

TEST_F(ShadowGLTest, TheLookupIsTheSameInTheColourPass) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    stage(sun.node);
    const View top = view(topView(), 256, 256);
    const auto colors = picture(top);
    const auto shadow = factor(top, sun.node);
    const double cosine = 2.0 / std::sqrt(5.0);
    const Rgb lit{encoded(0.8 * (0.20 + cosine)), encoded(0.8 * (0.22 + cosine)),
                  encoded(0.8 * (0.26 + cosine))};
    const Rgb dark{encoded(0.8 * 0.20), encoded(0.8 * 0.22), encoded(0.8 * 0.26)};
    expectClose(at(colors, -5.0, 3.0), lit, 2, "lit ground");
    expectClose(at(colors, 1.5, 0.0), dark, 2, "shadowed ground");
    int compared = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const int f = pixel(shadow, x, y)[0];
            if (f != 0 && f != 255) continue;
            ++compared;
            ASSERT_NEAR(pixel(colors, x, y)[0], f == 255 ? lit[0] : dark[0], 2) << x << ", " << y;
        }
    }
    EXPECT_GT(compared, 60'000);
}

TEST_F(ShadowGLTest, TheFactorIs128WhereThereIsNoSurfaceAnd0WhereItFacesAway) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, -1.0, 0.0}, {0.0, 0.0, 0.0});
    const auto ground = paint(sun.node, phong(vec3{0.8F}));
    add(ground.node, quad({-2.0F, 0.0F, 2.0F}, {4.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -4.0F}));
    const View top = view(topView(), 64, 64);
    const auto shadow = factor(top, sun.node);
    EXPECT_EQ(at(shadow, 0.0, 0.0)[0], 0) << "the light is below";
    EXPECT_EQ(at(shadow, 5.0, 5.0)[0], 128);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const int f = pixel(shadow, x, y)[0];
            EXPECT_TRUE(f == 0 || f == 128) << f;
        }
    EXPECT_FALSE(renderer->shadowFactor(copyOf(top.window), 0, scene::Ref<scene::Node>{root}));
    EXPECT_FALSE(renderer->shadowFactor(copyOf(top.window), 1, scene::Ref<scene::Node>{sun.node}));
}

TEST_F(ShadowGLTest, ALitSurfaceDoesNotShadowItself) {
    // Grazing light over a plain ground: the depth offset must clear every texel.
    for (const double height : {2.0, 0.5, 0.15}) {
        const auto sun = light<scene::DirectionalLight>(root, {-1.0, height, 0.3}, {0.0, 0.0, 0.0});
        const auto ground = paint(sun.node, phong(vec3{0.8F}));
        add(ground.node, quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
        const View top = view(topView(), 128, 128);
        edit(top.viewport)->mapSize = 256;
        const auto shadow = factor(top, sun.node);
        int dark = 0;
        for (const auto f : shadow.pixels) dark += f != 255 ? 1 : 0;
        EXPECT_EQ(dark, 0) << "height " << height;
        edit(root)->removeChild(sun.node);
        ASSERT_TRUE(app.destroyTree(sun.node).has_value());
        ASSERT_TRUE(app.destroyTree(top.window).has_value());
    }
}

TEST_F(ShadowGLTest, ExcludedSubtreesCastNone) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    const auto group = scene::makeNode<scene::Group>(app, "group");
    edit(root)->addChild(group.node);
    edit(group.node)->addChild(sun.node);
    stage(sun.node);
    const View top = view(topView(), 64, 64);
    EXPECT_EQ(at(factor(top, sun.node), 1.5, 0.0)[0], 0);
    edit(top.viewport)->excludeNodes.assign({scene::Ref<scene::Node>{group.node}});
    EXPECT_EQ(at(factor(top, sun.node), 1.5, 0.0)[0], 255);
}

TEST_F(ShadowGLTest, ShadowColorSaysHowDarkAShadowIs) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    stage(sun.node);
    const View top = view(topView(), 64, 64);
    const double cosine = 2.0 / std::sqrt(5.0);
    edit(top.viewport)->shadowColor = math::vec4{0.0F, 0.0F, 0.0F, 0.5F};
    expectClose(at(picture(top), 1.5, 0.0),
                {encoded(0.8 * (0.20 + 0.5 * cosine)), encoded(0.8 * (0.22 + 0.5 * cosine)),
                 encoded(0.8 * (0.26 + 0.5 * cosine))},
                2, "half dark");
    edit(top.viewport)->shadowColor = math::vec4{1.0F, 0.0F, 0.0F, 1.0F};
    const auto red = at(picture(top), 1.5, 0.0);
    EXPECT_NEAR(red[0], encoded(0.8 * (0.20 + cosine)), 1);
    EXPECT_EQ(red[1], encoded(0.8 * 0.22));
}

TEST_F(ShadowGLTest, WithoutShadowsEverythingThatFacesTheLightIsLit) {
    const auto sun = light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    stage(sun.node);
    const View top = view(topView(), 64, 64);
    const auto with = picture(top);
    edit(top.viewport)->technique = "none";
    const auto none = picture(top);
    edit(top.viewport)->technique = "std";
    edit(top.viewport)->shadowOn = false;
    EXPECT_EQ(picture(top), none);
    EXPECT_EQ(at(none, 1.5, 0.0), at(none, -5.0, 3.0));
    EXPECT_NE(at(with, 1.5, 0.0), at(none, 1.5, 0.0));
    EXPECT_EQ(at(with, -5.0, 3.0), at(none, -5.0, 3.0));
}

}  // namespace
}  // namespace gnomon::render
