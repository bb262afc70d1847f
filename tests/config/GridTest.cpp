#include <gtest/gtest.h>

#include "Walls.h"

namespace gnomon::config {
namespace {

constexpr const char* gridWall = R"(
[[screen]]
name = "front"
lower_left = [-1.5, 1.0, 0.0]
lower_right = [1.5, 1.0, 0.0]
upper_left = [-1.5, 3.0, 0.0]
tiles = [3, 2]
[[server_grid]]
screen = "front"
eyes = ["left", "right"]
name = "{screen}.{column}.{row}.{eye1}"
host = "node{tile+1:03}"
port = [7430, 7431]
gpu = [1, 0]
window = [640, 640]
fullscreen = true
monitor = 1
)";

TEST(Grid, MakesAServerForEachTileAndEye) {
    const Inspection inspection = inspectConfig(gridWall, "wall.toml");
    ASSERT_TRUE(inspection.config) << allText(inspection.findings);
    EXPECT_EQ(allText(inspection.findings), "");
    const auto& servers = inspection.config->servers;
    ASSERT_EQ(servers.size(), 12U);
    std::size_t i = 0;
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column) {
            for (const Eye eye : {Eye::left, Eye::right}) {
                const Server& server = servers[i++];
                const bool isLeft = eye == Eye::left;
                EXPECT_EQ(server.name, "front." + std::to_string(column) + "." +
                                           std::to_string(row) + (isLeft ? ".l" : ".r"));
                EXPECT_EQ(server.host, "node00" + std::to_string(row * 3 + column + 1));
                EXPECT_EQ(server.port, isLeft ? 7430 : 7431);
                EXPECT_EQ(server.gpu, isLeft ? 1 : 0);
                ASSERT_EQ(server.windows.size(), 1U);
                EXPECT_EQ(server.windows[0].size, (Cells{640, 640}));
                EXPECT_TRUE(server.windows[0].fullscreen);
                EXPECT_EQ(server.windows[0].monitor, 1);
                ASSERT_EQ(server.windows[0].viewports.size(), 1U);
                EXPECT_EQ(server.windows[0].viewports[0].tile, (Cells{column, row}));
                EXPECT_EQ(server.windows[0].viewports[0].eye, eye);
            }
        }
    }
}

TEST(Grid, ComesAfterTheServersWrittenOneByOne) {
    const std::string text =
        replaced(gridWall, "[[server_grid]]",
                 "[[server]]\nname = \"first\"\nhost = \"x\"\n[[server.window]]\nsize = [64, "
                 "64]\n[[server.window.viewport]]\nscreen = \"front\"\n[[server_grid]]");
    const Inspection inspection = inspectConfig(text, "wall.toml");
    // It shows tile 0, 0 in mono and in another size: wrong, but expanded in this order.
    ASSERT_FALSE(inspection.findings.empty());
    EXPECT_NE(inspection.findings[0].what.find("server \"first\""), std::string::npos)
        << allText(inspection.findings);
}

// gridWall with one text replaced, and the error that must come first.
struct BrokenGrid {
    const char* name = "";
    const char* from = "";
    const char* to = "";
    const char* error = "";
};

void PrintTo(const BrokenGrid& broken, std::ostream* out) { *out << broken.name; }

constexpr BrokenGrid brokenGrids[] = {
    {.name = "unknownScreen",
     .from = "screen = \"front\"",
     .to = "screen = \"fornt\"",
     .error = "wall.toml:9:10: server_grid: there is no screen \"fornt\", did you mean \"front\"?"},
    {.name = "noWindow",
     .from = "window = [640, 640]\n",
     .to = "",
     .error = "wall.toml:8:1: server_grid of screen \"front\": window is missing"},
    {.name = "noEye",
     .from = "[\"left\", \"right\"]",
     .to = "[]",
     .error = "wall.toml:10:8: server_grid of screen \"front\": eyes is an empty list"},
    {.name = "eyeTwice",
     .from = "[\"left\", \"right\"]",
     .to = "[\"left\", \"left\"]",
     .error = "wall.toml:10:8: server_grid of screen \"front\": eyes is [\"left\", \"left\"], must "
              "not name an eye twice"},
    {.name = "eyeNotAList",
     .from = "[\"left\", \"right\"]",
     .to = "\"left\"",
     .error = "wall.toml:10:8: server_grid of screen \"front\": eyes is \"left\", must be a list"},
    {.name = "threeGpus",
     .from = "gpu = [1, 0]",
     .to = "gpu = [1, 0, 2]",
     .error = "wall.toml:14:7: server_grid of screen \"front\": gpu is [1, 0, 2], must be one "
              "number or one for each of the 2 eyes"},
    {.name = "noPorts",
     .from = "port = [7430, 7431]",
     .to = "port = []",
     .error = "wall.toml:13:8: server_grid of screen \"front\": port is [], must be one number"},
    {.name = "onePortForTwoServersOfAHost",
     .from = "port = [7430, 7431]",
     .to = "port = 7430",
     .error = "wall.toml:13:8: server \"front.0.0.r\": node001 port 7430 is taken by server "
              "\"front.0.0.l\""},
    {.name = "unknownWord",
     .from = "{tile+1:03}",
     .to = "{colum}",
     .error = "wall.toml:12:8: server_grid of screen \"front\": host has {colum}, must be one of "
              "\"screen\", \"column\", \"row\", \"tile\", \"index\", \"eye\" or \"eye1\", did you "
              "mean \"column\"?"},
    {.name = "malformedWord",
     .from = "{tile+1:03}",
     .to = "{tile+:03}",
     .error = "wall.toml:12:8: server_grid of screen \"front\": host has {tile+:03}, must be like "
              "{tile}, {tile+1} or {tile+1:02}"},
    {.name = "openBrace",
     .from = "{tile+1:03}",
     .to = "{tile",
     .error = "wall.toml:12:8: server_grid of screen \"front\": host has '{' without '}'"},
    {.name = "sameNames",
     .from = ".{eye1}",
     .to = "",
     .error = "wall.toml:11:8: server \"front.0.0\": there is another server of that name"},
    {.name = "badHost",
     .from = "node{",
     .to = "-n{",
     .error = "wall.toml:12:8: server \"front.0.0.l\": host is \"-n001\", must be a host name"},
};

class BrokenGridWall : public testing::TestWithParam<BrokenGrid> {};

TEST_P(BrokenGridWall, IsRefusedWithItsPlace) {
    const std::string text = replaced(gridWall, GetParam().from, GetParam().to);
    ASSERT_NE(text, gridWall) << "the case replaces nothing";
    const auto config = parseConfig(text, "wall.toml");
    ASSERT_FALSE(config);
    EXPECT_EQ(config.error().what.rfind(GetParam().error, 0), 0U) << config.error().what;
}

INSTANTIATE_TEST_SUITE_P(All, BrokenGridWall, testing::ValuesIn(brokenGrids),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Pattern {
    const char* pattern = "";
    const char* first = "";  // server 0: column 0, row 0, left
    const char* last = "";   // server 11: column 2, row 1, right
};

TEST(Grid, FillsInPatterns) {
    constexpr Pattern patterns[] = {
        {"n{index}", "n0", "n11"},
        {"n{index:03}", "n000", "n011"},
        {"n{index+1:02}", "n01", "n12"},
        {"n{index+100}", "n100", "n111"},
        {"{eye}{column}{row}x{index}", "left00x0", "right21x11"},
        {"{screen}-{tile}{eye1}", "front-0l", "front-5r"},
    };
    for (const Pattern& pattern : patterns) {
        const auto config = parseConfig(
            replaced(gridWall, "{screen}.{column}.{row}.{eye1}", pattern.pattern), "wall.toml");
        ASSERT_TRUE(config) << config.error().text();
        EXPECT_EQ(config->servers.front().name, pattern.first);
        EXPECT_EQ(config->servers.back().name, pattern.last);
    }
}

}  // namespace
}  // namespace gnomon::config
