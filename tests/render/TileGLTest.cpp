// A wall assembled from tiles equals the same picture in one piece.
#include <algorithm>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::vec3;

class TileGLTest : public RenderTest {
protected:
    std::string technique = "std";
    double softness = 0.0;
    /// Everything that could differ at a seam: shadows of a sun and a spot, a gradient, a blended
    /// surface, geometry across all seams.
    void plaza(const scene::Node& below) {
        add(paint(below, phong(vec3{0.6F, 0.55F, 0.5F})).node,
            quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
        for (int x = -2; x <= 2; ++x) {
            for (int z = -2; z <= 2; ++z) {
                const auto place = transform(
                    below, {.translation = {x * 2.2, 0.0, z * 2.3},
                            .linear = math::mat3{0.4F + 0.05F * static_cast<float>(x + z)}});
                const auto& material = phong(vec3{0.4F + 0.1F * static_cast<float>(x), 0.5F, 0.3F});
                edit(material)->specular = vec3{0.2F};
                add(paint(place.node, material).node,
                    box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 3.0F, 1.0F}), true);
            }
        }
        const auto& glass = phong(vec3{0.0F});
        {
            auto e = edit(glass);
            e->diffuse = math::vec4{0.2F, 0.4F, 0.9F, 0.5F};
            e->alpha = scene::PhongMaterial::Alpha::blend;
            e->doubleSided = true;
        }
        add(paint(below, glass).node,
            quad({-3.0F, 0.5F, 4.0F}, {6.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.0F}));
    }
    struct Lights {
        scene::NodeWith<scene::DirectionalLight> sun;
        scene::NodeWith<scene::SpotLight> spot;
    };
    /// The plaza, and what lights it.
    Lights litPlaza() {
        const auto sun = light<scene::DirectionalLight>(root, {-2.0, 3.0, 1.0}, {0.0, 0.0, 0.0});
        const auto spot = light<scene::SpotLight>(sun.node, {3.0, 7.0, 4.0}, {0.0, 0.0, 0.0});
        edit(sun.core)->intensity = 0.5F;
        plaza(spot.node);
        return {sun, spot};
    }
    const scene::GradientBackground& gradient() {
        const auto& made = app.create<scene::GradientBackground>();
        edit(made)->stops.assign({math::vec4{0.1F, 0.1F, 0.3F, 0.0F},
                                  math::vec4{0.8F, 0.5F, 0.2F, 0.4F},
                                  math::vec4{0.2F, 0.5F, 0.9F, 1.0F}});
        return made;
    }
    /// The picture of @p camera in one piece, and assembled from columns x rows tiles.
    struct Both {
        image::Image whole = {};
        image::Image assembled = {};
    };
    Both render(const scene::Camera& camera, int columns, int rows, glm::ivec2 tileSize,
                const scene::Background& background, int mapSize, int samples = 1) {
        const auto prepare = [&](const View& made) {
            {
                auto e = edit(made.viewport);
                e->mapSize = mapSize;
                e->background = background;
                e->technique = technique;
                e->softness = static_cast<float>(softness);
            }
            edit(made.window)->samples = samples;
        };
        const int width = tileSize.x * columns;
        const int height = tileSize.y * rows;
        const View one = view(camera, width, height);
        prepare(one);
        std::vector<View> tiles;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const auto& tile = app.create<scene::TileDecorator>();
                {
                    auto e = edit(tile);
                    e->decoratee = camera;
                    e->part = math::Rect{.left = static_cast<double>(column) / columns,
                                         .bottom = static_cast<double>(row) / rows,
                                         .width = 1.0 / columns,
                                         .height = 1.0 / rows};
                }
                tiles.push_back(view(tile, tileSize.x, tileSize.y));
                prepare(tiles.back());
            }
        }
        Both both;
        both.whole = picture(one);
        both.assembled = image::blank(width, height, 3);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            // As another server would: it knows nothing of the pages drawn for the others.
            renderer->forgetShadows();
            const auto part = picture(tiles[i]);
            const int column = static_cast<int>(i) % columns;
            const int top = (rows - 1 - static_cast<int>(i) / columns) * tileSize.y;
            for (int y = 0; y < tileSize.y; ++y)
                std::copy_n(
                    part.pixels.begin() + std::ptrdiff_t{y} * tileSize.x * 3, tileSize.x * 3,
                    both.assembled.pixels.begin() +
                        (std::ptrdiff_t{top + y} * width + std::ptrdiff_t{column} * tileSize.x) *
                            3);
        }
        return both;
    }
    static void expectEqual(const Both& both) {
        const auto difference = image::compare(both.whole, both.assembled, 2);
        ASSERT_TRUE(difference.has_value());
        EXPECT_LE(difference->share, 0.0001) << "largest " << difference->largest;
    }
    /// That the picture has shadows at all, in which tiles could differ.
    static std::size_t colors(const image::Image& image) {
        std::vector<int> all;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3)
            all.push_back(image.pixels[i] * 65536 + image.pixels[i + 1] * 256 +
                          image.pixels[i + 2]);
        std::sort(all.begin(), all.end());
        return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
    }
    static void expectShades(const Both& both) {
        expectEqual(both);
        EXPECT_GT(colors(both.whole), 500U);
    }
};

TEST_F(TileGLTest, FourTilesEqualTheWholeWithShadowsInSeveralPages) {
    litPlaza();
    expectShades(render(perspectiveView({4.0, 5.0, 9.0}, {0.0, 0.5, 0.0}), 2, 2, {128, 128},
                        gradient(), 2048));
}

TEST_F(TileGLTest, SixTilesOfAnOffAxisScreenInStereo) {
    const auto sun = light<scene::DirectionalLight>(root, {-2.0, 3.0, 1.0}, {0.0, 0.0, 0.0});
    plaza(sun.node);
    const auto& screen = app.create<scene::Screen>();
    {
        auto e = edit(screen);
        e->lowerLeft = math::dvec3{-3.0, 0.0, 5.0};
        e->lowerRight = math::dvec3{3.0, 0.0, 5.0};
        e->upperLeft = math::dvec3{-3.0, 4.0, 5.0};
    }
    const auto& user = app.create<scene::User>();
    edit(user)->roomFromHead = math::Affine{.translation = {0.7, 2.6, 9.0}};
    for (const scene::Eye eye : {scene::Eye::left, scene::Eye::right}) {
        const auto& camera = app.create<scene::ScreenDecorator>();
        {
            auto e = edit(camera);
            e->decoratee = perspectiveView({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
            e->screen = screen;
            e->user = user;
            e->eye = eye;
        }
        expectEqual(render(camera, 3, 2, {64, 64}, gradient(), 2048));
    }
}

/// Every technique, on the walls there are.
class EveryTechniqueTileGLTest : public TileGLTest, public testing::WithParamInterface<Technique> {
protected:
    EveryTechniqueTileGLTest() {
        technique = GetParam().word();
        litPlaza();
    }
    /// One face of a room with a user in it.
    const scene::Camera& face(const math::dvec3& lowerLeft, const math::dvec3& lowerRight,
                              const math::dvec3& upperLeft, scene::Eye eye) {
        const auto& screen = app.create<scene::Screen>();
        {
            auto e = edit(screen);
            e->lowerLeft = lowerLeft;
            e->lowerRight = lowerRight;
            e->upperLeft = upperLeft;
        }
        const auto& user = app.create<scene::User>();
        edit(user)->roomFromHead = math::Affine{.translation = {0.4, 1.7, 6.5}};
        const auto& camera = app.create<scene::ScreenDecorator>();
        auto e = edit(camera);
        e->decoratee = perspectiveView({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
        e->screen = screen;
        e->user = user;
        e->eye = eye;
        return camera;
    }
};

TEST_P(EveryTechniqueTileGLTest, FourTilesEqualTheWhole) {
    expectShades(render(perspectiveView({4.0, 5.0, 9.0}, {0.0, 0.5, 0.0}), 2, 2, {128, 128},
                        gradient(), 1024));
}

TEST_P(EveryTechniqueTileGLTest, FourTilesInARowEqualTheWhole) {
    expectEqual(
        render(perspectiveView({4.0, 2.0, 9.0}, {0.0, 0.5, 0.0}), 4, 1, {96, 96}, gradient(), 512));
}

TEST_P(EveryTechniqueTileGLTest, StereoTilesEqualTheWhole) {
    for (const scene::Eye eye : {scene::Eye::left, scene::Eye::right}) {
        const auto& camera = app.create<scene::StereoDecorator>();
        {
            auto e = edit(camera);
            e->decoratee = perspectiveView({4.0, 5.0, 9.0}, {0.0, 0.5, 0.0});
            e->eye = eye;
        }
        expectEqual(render(camera, 2, 2, {96, 96}, gradient(), 512));
    }
}

TEST_P(EveryTechniqueTileGLTest, TheFacesOfACaveEqualTheWhole) {
    // Front, left and floor of a room that the plaza fills; the floor looks down at it.
    const auto& front = face({-1.5, 0.0, 5.0}, {1.5, 0.0, 5.0}, {-1.5, 3.0, 5.0}, scene::Eye::mono);
    const auto& left = face({-1.5, 0.0, 8.0}, {-1.5, 0.0, 5.0}, {-1.5, 3.0, 8.0}, scene::Eye::mono);
    const auto& floor = face({-1.5, 0.5, 8.0}, {1.5, 0.5, 8.0}, {-1.5, 0.5, 5.0}, scene::Eye::mono);
    for (const scene::Camera* camera : {&front, &left, &floor})
        expectEqual(render(*camera, 2, 2, {64, 64}, gradient(), 512));
}

INSTANTIATE_TEST_SUITE_P(All, EveryTechniqueTileGLTest, testing::ValuesIn(techniques()),
                         techniqueName);

// Kernels wider than a tile, cut off where they would be wider than its margin.
TEST_F(TileGLTest, WideKernelsOnTheScreenGoOnInTheNextTile) {
    technique = "lispsm+gauss";
    softness = 0.8;
    litPlaza();
    expectShades(render(perspectiveView({4.0, 3.0, 9.0}, {0.0, 0.5, 0.0}), 3, 3, {85, 51},
                        gradient(), 1024));
}

// What is traced of a pixel depends on its neighbours: those in the next tile, too.
TEST_F(TileGLTest, TracedPenumbraeGoOnInTheNextTile) {
    technique = "ray";
    const auto [sun, spot] = litPlaza();
    edit(sun.core)->angle = 0.05F;
    edit(spot.core)->radius = 0.5F;
    expectShades(
        render(perspectiveView({4.0, 3.0, 9.0}, {0.0, 0.5, 0.0}), 8, 8, {32, 32}, gradient(), 16));
}

TEST_F(TileGLTest, TilesWithMultisampling) {
    const auto sun = light<scene::DirectionalLight>(root, {-2.0, 3.0, 1.0}, {0.0, 0.0, 0.0});
    plaza(sun.node);
    expectEqual(render(perspectiveView({4.0, 5.0, 9.0}, {0.0, 0.5, 0.0}), 2, 2, {64, 64},
                       gradient(), 1024, 4));
}

TEST_F(TileGLTest, AGradientRunsAcrossTiles) {
    const auto both =
        render(perspectiveView({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}), 2, 4, {16, 32}, gradient(), 512);
    const auto difference = image::compare(both.whole, both.assembled, 1);
    EXPECT_EQ(difference->share, 0.0) << "largest " << difference->largest;
    // From the bottom's colour to the top's.
    expectClose(pixel(both.whole, 5, 127), {encoded(0.1), encoded(0.1), encoded(0.3)}, 4, "bottom");
    expectClose(pixel(both.whole, 5, 0), {encoded(0.2), encoded(0.5), encoded(0.9)}, 4, "top");
    expectClose(pixel(both.whole, 5, 76), {encoded(0.8), encoded(0.5), encoded(0.2)}, 8, "stop");
}

}  // namespace
}  // namespace gnomon::render
