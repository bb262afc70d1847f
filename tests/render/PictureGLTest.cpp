// What is in a picture beside shadows.
#include <cmath>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::vec3;

class PictureGLTest : public RenderTest {
protected:
    void ground(const scene::Node& below) {
        add(paint(below, phong(vec3{0.8F})).node,
            quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
    }
};

TEST_F(PictureGLTest, ASunAndASpotAddUpWhereTheSpotShines) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    edit(sun.core)->intensity = 0.3F;
    const auto spot = light<scene::SpotLight>(sun.node, {3.0, 5.0, 0.0}, {3.0, 0.0, 0.0});
    {
        auto e = edit(spot.core);
        e->outerAngle = 0.3F;
        e->innerAngle = 0.2F;
        e->color = vec3{1.0F, 0.0F, 0.0F};
        e->intensity = 0.4F;
    }
    ground(spot.node);
    const View top = view(topView(), 128, 128);
    const auto shown = picture(top);
    expectClose(at(shown, -4.0, 0.0),
                {encoded(0.8 * 0.5), encoded(0.8 * 0.52), encoded(0.8 * 0.56)}, 2, "sun alone");
    expectClose(at(shown, 3.0, 0.0), {encoded(0.8 * 0.9), encoded(0.8 * 0.52), encoded(0.8 * 0.56)},
                2, "sun and spot");
    // Outside the cone: 5 tan(0.3) = 1.55 m.
    EXPECT_EQ(at(shown, 3.0 + 1.7, 0.0), at(shown, -4.0, 0.0));
    edit(spot.core)->on = false;
    EXPECT_EQ(at(picture(top), 3.0, 0.0), at(shown, -4.0, 0.0));
}

TEST_F(PictureGLTest, APointLightFallsOffAndEndsAtItsRange) {
    const auto lamp = light<scene::PointLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    {
        auto e = edit(lamp.core);
        e->attenuation = vec3{0.0F, 0.0F, 1.0F};
        e->range = 6.0F;
        e->castsShadow = false;
    }
    ground(lamp.node);
    const View top = view(topView(), 160, 160);
    const auto shown = picture(top);
    const auto expected = [](double x) {
        const double square = x * x + 1.0;
        const double q = square / 36.0;
        const double window = std::pow(std::max(0.0, 1.0 - q * q), 2.0);
        return encoded(0.8 * (0.20 + window / square / std::sqrt(square)));
    };
    for (const double x : {0.05, 1.05, 2.05, 4.05, 7.05})
        EXPECT_NEAR(at(shown, x, 0.05)[0], expected(x), 3) << x;
}

TEST_F(PictureGLTest, LightsLightTheirSubtreeAlone) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    add(paint(sun.node, phong(vec3{0.8F})).node,
        quad({-8.0F, 0.0F, 8.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
    add(paint(root, phong(vec3{0.8F})).node,
        quad({0.0F, 0.0F, 8.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
    const View top = view(topView(), 64, 64);
    const auto shown = picture(top);
    EXPECT_NEAR(at(shown, -4.0, 0.0)[0], encoded(0.8 * 1.20), 1);
    EXPECT_NEAR(at(shown, 4.0, 0.0)[0], encoded(0.8 * 0.20), 1);
}

TEST_F(PictureGLTest, ThirtySpotsLightAndShadowAtOnce) {
    constexpr int count = 30;
    std::vector<scene::NodeWith<scene::SpotLight>> spots;
    const scene::Node* below = &root;
    std::vector<dvec3> places;
    for (int i = 0; i < count; ++i) {
        const dvec3 place{(i % 6) * 2.6 - 6.5, 0.0, static_cast<double>(i / 6) * 3.0 - 6.0};
        places.push_back(place);
        spots.push_back(light<scene::SpotLight>(*below, place + dvec3{0.0, 4.0, 0.0}, place));
        auto e = edit(spots.back().core);
        e->outerAngle = 0.25F;
        e->innerAngle = 0.2F;
        e->intensity = 0.5F;
        below = &spots.back().node;
    }
    ground(*below);
    // A small box under every light but the last.
    for (std::size_t i = 0; i + 1 < count; ++i)
        add(*below,
            box(vec3{places[i]} + vec3{-0.3F, 1.0F, -0.3F},
                vec3{places[i]} + vec3{0.3F, 1.2F, 0.3F}),
            true);
    const View top = view(topView(), 160, 160);
    edit(top.viewport)->mapSize = 256;
    const auto stats = draw(top);
    EXPECT_EQ(stats.lights, count);
    EXPECT_EQ(stats.pagesDrawn, 29U) << "a light with nothing to shadow needs no map";
    const auto shown = renderer->read(copyOf(top.window));
    const int lit = encoded(0.8 * 0.70);
    // Just outside the box's shadow (0.3 m, times 4/3) and inside the cone (0.8 m inner).
    for (const dvec3& place : places)
        EXPECT_NEAR(at(shown, place.x + 0.6, place.z)[0], lit, 6) << place.x << ", " << place.z;
    EXPECT_NEAR(at(shown, places.back().x, places.back().z)[0], lit, 3);
    EXPECT_NEAR(at(shown, places.front().x + 1.3, places.front().z + 1.5)[0], encoded(0.8 * 0.2),
                2);
    // Of the ring around each box, between 0.3 and 0.4 m, all is in its light's shadow.
    const auto first = factor(top, spots.front().node);
    EXPECT_EQ(at(first, places[0].x + 0.35, places[0].z)[0], 0);
    EXPECT_EQ(at(first, places[0].x + 0.6, places[0].z)[0], 255);
    const auto last = factor(top, spots.back().node);
    EXPECT_EQ(at(last, places.back().x, places.back().z)[0], 255);
}

TEST_F(PictureGLTest, MultisamplingSmoothsEdgesAndChangesNothingElse) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    add(paint(sun.node, phong(vec3{0.8F})).node,
        quad({-5.0F, 0.0F, 4.0F}, {9.0F, 0.0F, -2.0F}, {-1.0F, 0.0F, -7.0F}));
    const View top = view(topView(), 64, 64);
    const auto plain = picture(top);
    edit(top.window)->samples = 4;
    const auto smooth = picture(top);
    EXPECT_EQ(at(plain, 0.0, 0.0), at(smooth, 0.0, 0.0));
    EXPECT_EQ(at(plain, 7.5, 7.5), at(smooth, 7.5, 7.5));
    const auto between = [&](const image::Image& image) {
        int found = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3)
            found += image.pixels[i] > 5 && image.pixels[i] < at(plain, 0.0, 0.0)[0] - 5 ? 1 : 0;
        return found;
    };
    EXPECT_EQ(between(plain), 0);
    EXPECT_GT(between(smooth), 30);
}

TEST_F(PictureGLTest, AForegroundIsDrawnLastAndUnshadowed) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    ground(sun.node);
    const auto& logo = app.create<scene::Texture>();
    {
        // Top row red and green, bottom row blue and clear.
        static constexpr std::uint8_t rgba[] = {255, 0, 0,   255, 0, 255, 0, 255,
                                                0,   0, 255, 255, 9, 9,   9, 0};
        auto e = edit(logo);
        e->pixels = field::Payload::of<std::uint8_t>(rgba);
        e->size = glm::ivec2{2, 2};
        e->nearest = true;
        e->mipmaps = false;
    }
    const auto& shown = app.create<scene::ImageForeground>();
    {
        auto e = edit(shown);
        e->image = logo;
        e->rect = math::Rect{.left = 0.5, .bottom = 0.0, .width = 0.5, .height = 0.5};
    }
    const View top = view(topView(), 64, 64);
    const auto without = picture(top);
    edit(top.viewport)->foregrounds.assign({scene::Ref<scene::Foreground>{shown}});
    const auto with = picture(top);
    EXPECT_EQ(pixel(with, 40, 40), (Rgb{255, 0, 0}));
    EXPECT_EQ(pixel(with, 56, 40), (Rgb{0, 255, 0}));
    EXPECT_EQ(pixel(with, 40, 56), (Rgb{0, 0, 255}));
    EXPECT_EQ(pixel(with, 56, 56), pixel(without, 56, 56));
    EXPECT_EQ(pixel(with, 10, 40), pixel(without, 10, 40));
    edit(shown)->rect = math::Rect{.left = 0.0, .bottom = 60.0, .width = 4.0, .height = 4.0};
    const auto pixels = picture(top);
    EXPECT_EQ(pixel(pixels, 0, 0), (Rgb{255, 0, 0}));
    EXPECT_EQ(pixel(pixels, 5, 5), pixel(without, 5, 5));
}

TEST_F(PictureGLTest, TwoViewportsOfAWindowAreDrawnBesideEachOther) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    ground(sun.node);
    const View left = view(topView(), 64, 32);
    const View right = view(topView(), 1, 1);
    const auto& red = app.create<scene::SolidBackground>();
    edit(red)->color = vec3{1.0F, 0.0F, 0.0F};
    const auto& empty = app.create<scene::Node>();
    edit(left.viewport)->rect = math::Rect{.width = 0.5};
    {
        auto e = edit(right.viewport);
        e->rect = math::Rect{.left = 0.5, .width = 0.5};
        e->root = empty;
        e->background = red;
    }
    edit(left.window)->viewports.pushBack(scene::Ref<scene::Viewport>{right.viewport});
    edit(right.window)->viewports.clear();
    const auto shown = picture(left);
    EXPECT_NEAR(pixel(shown, 31, 16)[0], encoded(0.8 * 1.20), 1);
    EXPECT_EQ(pixel(shown, 32, 16), (Rgb{255, 0, 0}));
    EXPECT_EQ(pixel(shown, 63, 0), (Rgb{255, 0, 0}));
}

}  // namespace
}  // namespace gnomon::render
