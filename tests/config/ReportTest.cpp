#include <gtest/gtest.h>

#include "Walls.h"

namespace gnomon::config {
namespace {

std::string warningsOf(const std::string& text) {
    const Inspection inspection = inspectConfig(text, "wall.toml");
    EXPECT_TRUE(inspection.config) << allText(inspection.findings);
    return allText(inspection.findings);
}

TEST(Findings, AMissingTileIsAWarning) {
    std::string text = replaced(smallWall, "tiles = [2, 1]", "tiles = [2, 4]");
    text = replaced(text, "2.0, 0.0]", "5.0, 0.0]");
    EXPECT_EQ(warningsOf(text),
              "wall.toml:10:1: warning: screen \"front\": no server shows tile [0, 1], [1, 1], "
              "[0, 2], [1, 2] and 2 more\n");
}

TEST(Findings, AMissingEyeIsAWarning) {
    std::string text = replaced(smallWall, "tile = [0, 0]", "tile = [0, 0]\neye = \"left\"");
    text = replaced(text, "tile = [1, 0]", "tile = [1, 0]\neye = \"left\"");
    EXPECT_EQ(warningsOf(text),
              "wall.toml:10:1: warning: screen \"front\": no server shows it to the right eye\n");
    text = replaced(text, "[1, 0]\neye = \"left\"", "[0, 0]\neye = \"right\"");
    EXPECT_EQ(warningsOf(text),
              "wall.toml:10:1: warning: screen \"front\": no server shows tile [1, 0] to the left "
              "eye\n"
              "wall.toml:10:1: warning: screen \"front\": no server shows tile [1, 0] to the right "
              "eye\n");
}

TEST(Findings, AScreenNobodyShowsIsAWarning) {
    const std::string text =
        replaced(smallWall, "[[server]]",
                 "[[screen]]\nname = \"spare\"\nlower_left = [0, 0, 0]\nlower_right = [1, 0, "
                 "0]\nupper_left = [0, 1, 0]\n[[server]]");
    EXPECT_EQ(warningsOf(text), "wall.toml:16:1: warning: screen \"spare\": no server shows it\n");
}

TEST(Findings, PixelsThatAreNotSquareAreAWarning) {
    const std::string text = replaced(smallWall, "lower_right = [1.0", "lower_right = [2.0");
    EXPECT_EQ(warningsOf(text),
              "wall.toml:10:1: warning: screen \"front\": its pixels are 3.75 x 2.50 mm, not "
              "square; do corners and window size match?\n");
}

TEST(Findings, ViewportsThatCoverEachOtherAreAWarning) {
    std::string text = replaced(smallWall, "tile = [0, 0]",
                                "tile = [0, 0]\nrect = [0, 0, 400, 400]\n"
                                "[[server.window.viewport]]\nscreen = \"front\"\ntile = [1, 0]\n"
                                "rect = [399, 0, 400, 400]");
    text = replaced(text, "[400, 400]", "[800, 400]");
    text = text.substr(0, text.find("[[server]]\nname = \"east\""));
    EXPECT_EQ(
        warningsOf(text),
        "wall.toml:28:8: warning: server \"west\", window, viewport covers part of another in "
        "its window\n");
}

TEST(Findings, TwoFullScreensOnOneMonitorAreAWarning) {
    std::string text = replaced(smallWall, "pc2\"", "pc1\"\nport = 7431");
    text = replaced(text, "size = [400, 400]", "fullscreen=true\nsize = [400,400]");
    text = replaced(text, "size = [400, 400]", "fullscreen=true\nsize = [400,400]");
    EXPECT_EQ(warningsOf(text),
              "wall.toml:30:12: warning: server \"east\": full screen on monitor 0 of gpu -1 of "
              "pc1, which server \"west\" fills already\n");
    text = replaced(text, "port = 7431", "port = 7431\ngpu = 1");
    EXPECT_EQ(warningsOf(text), "");
}

TEST(Findings, ASecondLookAtALoadedConfigFindsTheSame) {
    const Inspection inspection =
        inspectConfig(replaced(smallWall, "lower_right = [1.0", "lower_right = [2.0"), "w.toml");
    ASSERT_TRUE(inspection.config);
    EXPECT_EQ(allText(findings(*inspection.config)), allText(inspection.findings));
}

TEST(Findings, OfAConfigMadeInCodeHaveNoPosition) {
    Config config = parseConfig(smallWall, "wall.toml").value();
    config.user = {.head = {0, 1, -1}};
    config.screens[0].origin = {};
    EXPECT_EQ(findings(config).at(0).text().rfind("user: an eye is 1 m behind the plane", 0), 0U)
        << allText(findings(config));
}

TEST(Describe, SaysWhoShowsWhat) {
    const Config config = parseConfig(smallWall, "wall.toml").value();
    EXPECT_EQ(describe(config), R"(small: 2 servers on 1 screen
head at 0, 1.7, 3 m, eyes 63 mm apart; shadows std, map 1024

server  host  port  gpu  window          viewport  screen  tile  eye
west    pc1   7430  any  400x400 at 0,0  whole     front   0,0   mono
east    pc2   7430  any  400x400 at 0,0  whole     front   1,0   mono

fit groups (all tiles and eyes of a screen share its shadow fits)
screen  metres         tiles  tile px    between  whole px   mm/px          eyes
front   2.000 x 1.000  2 x 1  400 x 400  -        800 x 400  2.500 x 2.500  mono
)");
}

TEST(Svg, IsWellFormedWhateverNamesSay) {
    const Config config =
        parseConfig(replaced(smallWall, "\"small\"", "\"a <b> & \\\"c\\\"\""), "wall.toml").value();
    const std::string picture = svg(config);
    EXPECT_NE(picture.find(">a &lt;b&gt; &amp; &quot;c&quot;<"), std::string::npos);
    EXPECT_EQ(picture.find("nan"), std::string::npos);
    // Every element is closed.
    std::size_t open = 0;
    std::size_t closed = 0;
    for (std::size_t i = 0; i + 1 < picture.size(); ++i) {
        if (picture[i] == '<') ++(picture[i + 1] == '/' ? closed : open);
        if (picture[i] == '/' && picture[i + 1] == '>') ++closed;
    }
    EXPECT_EQ(open, closed);
    EXPECT_GT(open, 10U);
}

TEST(Svg, ShowsATileNobodyShows) {
    const std::string text = replaced(replaced(smallWall, "tiles = [2, 1]", "tiles = [3, 1]"),
                                      "lower_right = [1.0", "lower_right = [2.0");
    const Config config = parseConfig(text, "wall.toml").value();
    EXPECT_NE(svg(config).find(">nobody<"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::config
