// Scenes that are broken are drawn without their broken parts, and without an OpenGL error.
#include <limits>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::vec3;

class RobustGLTest : public RenderTest {
protected:
    RobustGLTest() {
        add(paint(sun.node, phong(vec3{0.8F})).node,
            quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
    }
    const scene::NodeWith<scene::DirectionalLight> sun =
        light<scene::DirectionalLight>(root, {-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    const View top = view(topView(), 64, 64);
};

TEST_F(RobustGLTest, BrokenGeometryDrawsNothing) {
    const auto good = picture(top);
    const auto broken = [&](auto damage) {
        const auto& mesh =
            add(sun.node, box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 2.0F, 1.0F}), true);
        {
            auto e = edit(mesh);
            damage(*e);
        }
        EXPECT_EQ(picture(top), good);
        const auto parent = sun.node.children()[sun.node.children().size() - 1];
        const auto& node = *app.get(parent);
        edit(sun.node)->removeChild(node);
        ASSERT_TRUE(app.destroyTree(node).has_value());
    };
    using scene::Geometry;
    const auto indices = [](std::vector<std::uint32_t> list) {
        return field::Payload::of<std::uint32_t>(list);
    };
    broken([&](Geometry& g) { g.indices = indices({0, 1, 24}); });
    broken([&](Geometry& g) { g.indices = indices({0, 1, 0xffffffffU}); });
    broken([&](Geometry& g) { g.indices = field::Payload{}; });
    broken([&](Geometry& g) { g.positions = field::Payload{}; });
    broken([&](Geometry& g) {
        auto chunk = g.chunks[0];
        chunk.indexCount = 0xfffffff0U;
        g.chunks.set(0, chunk);
    });
    broken([&](Geometry& g) {
        auto chunk = g.chunks[0];
        chunk.firstIndex = 0xfffffff0U;
        chunk.indexCount = 0x20U;
        g.chunks.set(0, chunk);
    });
    broken([&](Geometry& g) { g.chunks.clear(); });
    broken([&](Geometry& g) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        g.boundsMin = vec3{nan};
    });
}

TEST_F(RobustGLTest, StreamsOfTheWrongLengthAreIgnored) {
    const auto& mesh = add(sun.node, box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 2.0F, 1.0F}), true);
    const auto good = picture(top);
    {
        const std::vector<float> few(7, 0.5F);
        auto e = edit(mesh);
        e->normals = field::Payload::of<float>(few);
        e->texCoords = field::Payload::of<float>(few);
        e->tangents = field::Payload::of<float>(few);
        e->colors = field::Payload::of<float>(few);
    }
    EXPECT_EQ(picture(top), good);
}

TEST_F(RobustGLTest, ATextureWhosePixelsDoNotFitIsIgnored) {
    const auto& material = phong(vec3{0.5F});
    add(paint(sun.node, material).node, box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 2.0F, 1.0F}),
        true);
    const auto good = picture(top);
    for (const glm::ivec2& size :
         {glm::ivec2{2, 2}, glm::ivec2{-4, -1}, glm::ivec2{0, 0}, glm::ivec2{1 << 30, 1 << 30}}) {
        const auto& texture = app.create<scene::Texture>();
        {
            static constexpr std::uint8_t rgba[] = {1, 2, 3, 4};
            auto e = edit(texture);
            e->pixels = field::Payload::of<std::uint8_t>(rgba);
            e->size = size;
        }
        edit(material)->diffuseMap = texture;
        EXPECT_EQ(picture(top), good);
    }
}

TEST_F(RobustGLTest, AViewThatCannotBeDrawnIsAnErrorAndNotACrash) {
    update();
    edit(top.viewport)->camera = scene::Ref<scene::Camera>{};
    update();
    auto drawn = renderer->draw(copyOf(top.window), 0.0);
    ASSERT_FALSE(drawn.has_value());
    EXPECT_EQ(drawn.error().code, Errc::edit);
    const auto& camera = topView();
    edit(camera)->eyeFromWorld = math::dmat4{std::numeric_limits<double>::quiet_NaN()};
    edit(top.viewport)->camera = camera;
    update();
    drawn = renderer->draw(copyOf(top.window), 0.0);
    ASSERT_FALSE(drawn.has_value());
    EXPECT_NE(drawn.error().what.find("finite"), std::string::npos) << drawn.error().what;
}

TEST_F(RobustGLTest, AnEmptySceneIsItsBackground) {
    edit(root)->removeChild(sun.node);
    const auto& green = app.create<scene::SolidBackground>();
    edit(green)->color = vec3{0.0F, 1.0F, 0.0F};
    edit(top.viewport)->background = green;
    const auto shown = picture(top);
    EXPECT_EQ(pixel(shown, 0, 0), (Rgb{0, 255, 0}));
    EXPECT_EQ(pixel(shown, 63, 63), (Rgb{0, 255, 0}));
    EXPECT_TRUE(renderer->read(copyOf(top.window)).width == 64);
}

TEST_F(RobustGLTest, SingularAndHugeTransformsDoNoHarm) {
    const auto good = picture(top);
    for (const float scale : {0.0F, 1e-30F}) {
        const auto place =
            transform(sun.node, {.translation = {0.0, -1.0, 0.0}, .linear = math::mat3{scale}});
        add(place.node, box(vec3{-1.0F}, vec3{1.0F}), true);
    }
    EXPECT_EQ(picture(top), good);
}

TEST_F(RobustGLTest, ThingsComeAndGoManyTimes) {
    const auto good = picture(top);
    for (int round = 0; round < 30; ++round) {
        const auto made = transform(sun.node, {.translation = {round * 0.1, 0.0, 0.0}});
        for (int i = 0; i <= round % 5; ++i)
            add(paint(made.node, phong(vec3{0.1F * static_cast<float>(i)})).node,
                box(vec3{0.0F, 0.0F, static_cast<float>(i)},
                    vec3{1.0F, 1.0F, static_cast<float>(i) + 0.5F}),
                true);
        draw(top);
        edit(sun.node)->removeChild(made.node);
        ASSERT_TRUE(app.destroyTree(made.node).has_value());
    }
    EXPECT_EQ(picture(top), good);
}

}  // namespace
}  // namespace gnomon::render
