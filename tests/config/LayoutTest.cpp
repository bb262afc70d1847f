#include <gnomon/config/Layout.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Walls.h"

namespace gnomon::config {
namespace {

Screen screenOf(double width, double height, Cells tiles) {
    return {.name = "s",
            .lowerLeft = {0, 0, 0},
            .lowerRight = {width, 0, 0},
            .upperLeft = {0, height, 0},
            .tiles = tiles};
}

// Every pixel of the canvas, and how many tiles have it.
std::vector<int> timesCovered(const Canvas& grid) {
    std::vector<int> times(static_cast<std::size_t>(grid.width * grid.height));
    for (int row = 0; row < grid.tiles[1]; ++row) {
        for (int column = 0; column < grid.tiles[0]; ++column) {
            const TileRect rect = grid.tile(column, row);
            for (int y = rect.y; y < rect.y + rect.height; ++y) {
                for (int x = rect.x; x < rect.x + rect.width; ++x) {
                    ++times.at(static_cast<std::size_t>(y * grid.width + x));
                }
            }
        }
    }
    return times;
}

TEST(Canvas, TilesCoverEveryPixelOnce) {
    const Canvas grid = canvas(screenOf(3, 2, {3, 2}), {50, 40}).value();
    EXPECT_EQ(grid.width, 150);
    EXPECT_EQ(grid.height, 80);
    EXPECT_EQ(grid.pitch[0], 3.0 / 150);
    EXPECT_EQ(grid.tile(0, 0), (TileRect{0, 0, 50, 40}));
    EXPECT_EQ(grid.tile(2, 1), (TileRect{100, 40, 50, 40}));
    for (const int times : timesCovered(grid)) ASSERT_EQ(times, 1);
}

TEST(Canvas, BezelsHidePixelsBetweenTiles) {
    // 2 tiles of 100 pixels and a bezel of 1/21 of the screen: 10 pixels.
    Screen screen = screenOf(2.1, 1, {2, 1});
    screen.bezel = {0.1, 0.5};  // one row: nothing across
    const Canvas grid = canvas(screen, {100, 100}).value();
    EXPECT_EQ(grid.gap, (Cells{10, 0}));
    EXPECT_EQ(grid.width, 210);
    EXPECT_EQ(grid.height, 100);
    const auto times = timesCovered(grid);
    for (int x = 0; x < 210; ++x) {
        EXPECT_EQ(times[static_cast<std::size_t>(x)], x >= 100 && x < 110 ? 0 : 1) << x;
    }
}

TEST(Canvas, OverlapsAreShared) {
    Screen screen = screenOf(2, 1, {3, 2});
    screen.overlap = {10, 4};
    const Canvas grid = canvas(screen, {100, 50}).value();
    EXPECT_EQ(grid.gap, (Cells{-10, -4}));
    EXPECT_EQ(grid.width, 280);
    EXPECT_EQ(grid.height, 96);
    EXPECT_EQ(grid.tile(1, 1), (TileRect{90, 46, 100, 50}));
    int twice = 0;
    int four = 0;
    for (const int times : timesCovered(grid)) {
        ASSERT_GE(times, 1);
        twice += times == 2 ? 1 : 0;
        four += times == 4 ? 1 : 0;
    }
    EXPECT_EQ(four, 2 * 10 * 4);
    EXPECT_EQ(twice, 2 * 10 * 96 - 2 * four + 280 * 4 - 2 * 10 * 4 + four);
}

TEST(Canvas, ABezelIsRoundedToTheNearestPixel) {
    for (const double metres : {0.0, 0.001, 0.0024, 0.01, 0.05, 0.2}) {
        Screen screen = screenOf(6, 2, {6, 2});
        screen.bezel = {metres, metres};
        const Canvas grid = canvas(screen, {640, 480}).value();
        for (std::size_t axis = 0; axis < 2; ++axis) {
            // Within half a pixel; its own rounding moves the pitch a little.
            EXPECT_NEAR(grid.gap[axis] * grid.pitch[axis], metres, 0.51 * grid.pitch[axis])
                << metres;
        }
        EXPECT_EQ(grid.width, 6 * 640 + 5 * grid.gap[0]);
        EXPECT_EQ(grid.height, 2 * 480 + grid.gap[1]);
    }
}

TEST(Canvas, SharesComeFromPixelsAndMeetAtTheBorder) {
    Screen screen = screenOf(3, 2, {3, 2});
    const Canvas grid = canvas(screen, {101, 77}).value();
    EXPECT_EQ(grid.share(0, 0).left, 0.0);
    EXPECT_EQ(grid.share(0, 0).top, 1.0);
    EXPECT_EQ(grid.share(2, 1).right, 1.0);
    EXPECT_EQ(grid.share(2, 1).bottom, 0.0);
    EXPECT_EQ(grid.share(0, 0).right, grid.share(1, 0).left);
    EXPECT_EQ(grid.share(0, 0).right, 101.0 / 303.0);
    EXPECT_EQ(grid.share(1, 0).bottom, grid.share(1, 1).top);
    EXPECT_EQ(grid.share(1, 0).bottom, 0.5);
}

TEST(Canvas, OfAConfigHasTheSizeOfItsViewports) {
    const Config config = parseConfig(smallWall, "wall.toml").value();
    EXPECT_EQ(canvas(config, 0)->tileSize, (Cells{400, 400}));
    EXPECT_EQ(canvas(config, 0)->width, 800);
    EXPECT_EQ(canvas(config, 0, Cells{30, 20})->width, 60);
    EXPECT_EQ(canvas(config, 0, Cells{30, 20})->height, 20);
}

TEST(Canvas, IsRefusedWhereItMakesNoSense) {
    Screen screen = screenOf(2, 1, {2, 1});
    EXPECT_FALSE(canvas(screen, {0, 10}));
    screen.bezel = {2, 0};
    EXPECT_FALSE(canvas(screen, {10, 10}));
    screen.bezel = {1.9999999, 0};  // 10^9 pixels behind the bezel
    EXPECT_FALSE(canvas(screen, {1000, 1000}));
    screen.bezel = {0, 0};
    screen.overlap = {10, 0};
    EXPECT_FALSE(canvas(screen, {10, 10}));
    EXPECT_TRUE(canvas(screen, {11, 10}));

    Config config = parseConfig(smallWall, "wall.toml").value();
    config.servers[1].windows[0].size = {400, 401};
    EXPECT_NE(canvas(config, 0).error().text().find("must be 400 x 400"), std::string::npos);
    config.servers.clear();
    EXPECT_NE(canvas(config, 0).error().text().find("no server shows it"), std::string::npos);
}

TEST(PixelRect, ThirdsOfAWindowAbut) {
    for (int width = 3; width < 200; ++width) {
        const Window window{.size = {width, 100}};
        int next = 0;
        for (int i = 0; i < 3; ++i) {
            const PixelRect rect =
                pixelRect(window, {.rect = {static_cast<double>(i) / 3, 0, 1.0 / 3, 1}});
            EXPECT_EQ(rect.left, next) << width;
            next = rect.left + rect.width;
        }
        EXPECT_EQ(next, width);
    }
}

TEST(PixelRect, SharesAndPixelsMix) {
    const Window window{.size = {1000, 500}};
    EXPECT_EQ(pixelRect(window, {}), (PixelRect{0, 0, 1000, 500}));
    EXPECT_EQ(pixelRect(window, {.rect = {0.5, 20, 300, 0.5}}), (PixelRect{500, 20, 300, 250}));
}

TEST(EyePosition, IsHalfTheSeparationToTheSide) {
    User user{.head = {1, 2, 3}, .eyeSeparation = 0.06};
    EXPECT_EQ(eyePosition(user, Eye::mono), user.head);
    EXPECT_DOUBLE_EQ(eyePosition(user, Eye::left)[0], 0.97);
    EXPECT_DOUBLE_EQ(eyePosition(user, Eye::right)[0], 1.03);
    user.forward = {-5, 1, 0};  // toward -x: right is -z
    EXPECT_DOUBLE_EQ(eyePosition(user, Eye::right)[2], 2.97);
    EXPECT_DOUBLE_EQ(eyePosition(user, Eye::right)[1], 2);
}

}  // namespace
}  // namespace gnomon::config
