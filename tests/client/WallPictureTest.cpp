#include <gnomon/client/SceneTree.h>
#include <gnomon/client/WallPicture.h>
#include <gnomon/config/Layout.h>
#include <gtest/gtest.h>

#include "Imported.h"

namespace gnomon::client {
namespace {

/// Two by two tiles of 20 x 10 pixels with a bezel, one server a column, its tiles in one window,
/// the upper one above the lower one; both eyes.
config::Config wall() {
    config::Config config;
    config.screens.push_back({.name = "front",
                              .lowerLeft = {-1, 0, 0},
                              .lowerRight = {1, 0, 0},
                              .upperLeft = {-1, 1, 0},
                              .tiles = {2, 2},
                              .bezel = {0.1, 0.1}});
    for (const auto eye : {config::Eye::left, config::Eye::right}) {
        for (int column = 0; column < 2; ++column) {
            config::Window window{.size = {20, 20}};
            for (int row = 0; row < 2; ++row)
                window.viewports.push_back({.screen = "front",
                                            .tile = {column, row},
                                            .eye = eye,
                                            .rect = {0.0, row == 0 ? 0.5 : 0.0, 1.0, 0.5}});
            config.servers.push_back(
                {.name = std::to_string(config.servers.size()), .windows = {window}});
        }
    }
    return config;
}

struct WallPictureTest : testing::Test {
    config::Config config = wall();
    field::TypeRegistry types = test::sceneTypes();
    field::Aspect aspect{types, 2};
    WallContainers containers = orThrow(buildWall(aspect, config, makeSceneTree(aspect).root));

    /// A window's picture; its red says which window, its green the row, its blue the column.
    net::Image image(std::size_t window, std::uint8_t channels = 3) const {
        net::Image made{.window = containers.windows[window].id.value,
                        .width = 20,
                        .height = 20,
                        .channels = channels};
        for (std::uint8_t y = 0; y < 20; ++y)
            for (std::uint8_t x = 0; x < 20; ++x) {
                for (const auto value : {static_cast<std::uint8_t>(100 + window), y, x})
                    made.pixels.push_back(value);
                if (channels == 4) made.pixels.push_back(7);
            }
        return made;
    }
    static std::array<int, 3> pixel(const image::Image& from, int x, int y) {
        const auto at = static_cast<std::size_t>((y * from.width + x) * 3);
        return {from.pixels[at], from.pixels[at + 1], from.pixels[at + 2]};
    }
};

TEST_F(WallPictureTest, TilesLieWhereTheCanvasHasThem) {
    const std::vector<net::Image> images{image(0), image(1, 4), image(2), image(3)};
    const auto pictures = orThrow(assembleWall(config, containers, images));
    ASSERT_EQ(pictures.size(), 2U);
    const auto canvas = orThrow(config::canvas(config, 0));
    ASSERT_GT(canvas.gap[0], 0);
    for (std::size_t eye = 0; eye < 2; ++eye) {
        const auto& picture = pictures[eye];
        EXPECT_TRUE(picture.missing.empty());
        EXPECT_EQ(picture.image.width, canvas.width);
        EXPECT_EQ(picture.image.height, canvas.height);
        const int server = static_cast<int>(eye) * 2;
        for (int column = 0; column < 2; ++column)
            for (int row = 0; row < 2; ++row) {
                const auto tile = canvas.tile(column, row);
                // Row 0 is the top row, and the top half of the window.
                const std::array<int, 3> first{100 + server + column, row * 10, 0};
                const std::array<int, 3> last{100 + server + column, row * 10 + 9, 19};
                EXPECT_EQ(pixel(picture.image, tile.x, tile.y), first);
                EXPECT_EQ(pixel(picture.image, tile.x + 19, tile.y + 9), last);
            }
        EXPECT_EQ(pixel(picture.image, 20, 5), (std::array<int, 3>{}));  // the bezel
        EXPECT_EQ(pixel(picture.image, 5, 10), (std::array<int, 3>{}));
    }
}

TEST_F(WallPictureTest, TilesOfLostServersAreBlackAndNamed) {
    const std::vector<net::Image> images{image(0), image(2), image(3)};
    const auto pictures = orThrow(assembleWall(config, containers, images));
    EXPECT_EQ(pictures[0].missing, (std::vector<std::string>{"1", "1"}));
    EXPECT_TRUE(pictures[1].missing.empty());
    const auto tile = orThrow(config::canvas(config, 0)).tile(1, 0);
    EXPECT_EQ(pixel(pictures[0].image, tile.x + 3, tile.y + 3), (std::array<int, 3>{}));
}

TEST_F(WallPictureTest, PicturesThatDoNotFitAreRefused) {
    auto wide = image(0);
    wide.x = 1;
    EXPECT_FALSE(assembleWall(config, containers, std::vector{wide}));
    auto cut = image(0);
    cut.pixels.pop_back();
    EXPECT_FALSE(assembleWall(config, containers, std::vector{cut}));
    auto stray = image(0);
    stray.window = 4711;
    EXPECT_FALSE(assembleWall(config, containers, std::vector{stray}));
}

TEST(WallPictureFile, IsNamedAfterScreenAndEyeWhereThereAreSeveral) {
    const WallPicture mono{.screen = "front"};
    EXPECT_EQ(pictureFile("a/wall.png", std::vector{mono}, mono), "a/wall.png");
    const WallPicture left{.screen = "front", .eye = config::Eye::left};
    const WallPicture right{.screen = "front", .eye = config::Eye::right};
    EXPECT_EQ(pictureFile("wall.png", std::vector{left, right}, right), "wall-right.png");
    const WallPicture floor{.screen = "floor", .eye = config::Eye::left};
    EXPECT_EQ(pictureFile("wall.png", std::vector{left, floor}, floor), "wall-floor-left.png");
}

}  // namespace
}  // namespace gnomon::client
