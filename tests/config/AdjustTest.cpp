#include <gnomon/config/Adjust.h>
#include <gnomon/config/Layout.h>
#include <gtest/gtest.h>

#include "Walls.h"

namespace gnomon::config {
namespace {

// One window with both tiles side by side, the second in pixels, a border of 10 pixels below.
constexpr const char* twoInOneWindow = R"(
[[screen]]
name = "front"
lower_left = [-0.95, 1.0, 0.0]
lower_right = [0.95, 1.0, 0.0]
upper_left = [-0.95, 2.0, 0.0]
tiles = [2, 1]
overlap = [40, 0]
[[server]]
name = "one"
host = "pc"
[[server.window]]
size = [800, 410]
position = [100, 50]
fullscreen = true
viewport = [
    { screen = "front", tile = [0, 0], rect = [0, 10, 0.5, 400] },
    { screen = "front", tile = [1, 0], rect = [400, 10, 400, 400] },
]
)";

TEST(WithTileSize, ScalesWindowsRectanglesAndOverlaps) {
    const Inspection inspection = inspectConfig(twoInOneWindow, "wall.toml");
    ASSERT_TRUE(inspection.config) << allText(inspection.findings);
    const auto small = withTileSize(*inspection.config, 100, 200);
    ASSERT_TRUE(small) << small.error().text();
    const Window& window = small->servers[0].windows[0];
    EXPECT_EQ(window.size, (Cells{200, 205}));
    EXPECT_EQ(window.position, (Cells{25, 25}));
    EXPECT_FALSE(window.fullscreen);
    EXPECT_EQ(pixelRect(window, window.viewports[0]), (PixelRect{0, 5, 100, 200}));
    EXPECT_EQ(pixelRect(window, window.viewports[1]), (PixelRect{100, 5, 100, 200}));
    EXPECT_EQ(small->screens[0].overlap, (Cells{10, 0}));
    EXPECT_EQ(canvas(*small, 0)->width, 190);
}

TEST(WithTileSize, APixelDoesNotBecomeTheWholeWindow) {
    const std::string text = replaced(twoInOneWindow, "rect = [0, 10", "rect = [0, 2");
    const Config config = parseConfig(text, "wall.toml").value();
    const auto half = withTileSize(config, 200, 200);
    ASSERT_TRUE(half) << half.error().text();
    const Window& window = half->servers[0].windows[0];
    EXPECT_EQ(pixelRect(window, window.viewports[0]), (PixelRect{0, 1, 200, 200}));
}

TEST(WithTileSize, TakesEveryTileToTheSameSize) {
    const Config config = parseConfig(smallWall, "wall.toml").value();
    for (const Cells size : {Cells{1, 1}, Cells{37, 91}, Cells{16384, 3}}) {
        const auto other = withTileSize(config, size[0], size[1]);
        ASSERT_TRUE(other) << other.error().text();
        EXPECT_EQ(canvas(*other, 0)->tileSize, size);
    }
    EXPECT_FALSE(withTileSize(config, 0, 5));
    EXPECT_FALSE(withTileSize(config, 5, -1));
    EXPECT_FALSE(withTileSize(config, 16385, 5));
}

TEST(WithTileSize, RefusesAWindowWhoseTilesCannotAllHaveIt) {
    // The window has a tile of each of two screens, of different sizes.
    const std::string text =
        replaced(replaced(twoInOneWindow, "tile = [1, 0], rect = [400, 10, 400, 400]",
                          "tile = [0, 0], rect = [400, 10, 100, 200]"),
                 "\"front\", tile = [0, 0], rect = [400", "\"side\", tile = [0, 0], rect = [400");
    const std::string twoScreens =
        replaced(text, "[[server]]",
                 "[[screen]]\nname = \"side\"\nlower_left = [2, 1, 0]\nlower_right = [2.5, 1, "
                 "0]\nupper_left = [2, 2, 0]\n[[server]]");
    const auto config = parseConfig(twoScreens, "wall.toml");
    ASSERT_TRUE(config) << config.error().text();
    const auto other = withTileSize(*config, 100, 100);
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().what.find("25 x 50 pixels where tiles of 100 x 100"), std::string::npos)
        << other.error().what;
}

TEST(Localized, IsOneMachineWithFreePorts) {
    const Config config = parseConfig(twoInOneWindow, "wall.toml").value();
    const Config local = localized(config);
    for (const Server& server : local.servers) {
        EXPECT_EQ(server.host, "localhost");
        EXPECT_EQ(server.port, 0);
        EXPECT_EQ(server.gpu, -1);
        for (const Window& window : server.windows) EXPECT_FALSE(window.fullscreen);
    }
    EXPECT_EQ(local.screens, config.screens);
    EXPECT_TRUE(findings(local).empty()) << allText(findings(local));
}

TEST(Arranged, PutsTilesWhereTheyAreAndRightEyesBeside) {
    const Config config =
        parseConfig(replaced(replaced(smallWall, "tile = [0, 0]", "eye = \"left\""),
                             "tile = [1, 0]", "tile = [1, 0]\neye = \"right\""),
                    "wall.toml")
            .value();
    const Config placed = arranged(config);
    EXPECT_EQ(placed.servers[0].windows[0].position, (Cells{0, 0}));
    EXPECT_EQ(placed.servers[1].windows[0].position, (Cells{800 + 400, 0}));
}

}  // namespace
}  // namespace gnomon::config
