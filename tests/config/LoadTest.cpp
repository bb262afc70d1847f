#include <gtest/gtest.h>

#include <filesystem>

#include "Walls.h"

namespace gnomon::config {
namespace {

TEST(Load, TheSmallWallIsRightAndHasItsValues) {
    const Inspection inspection = inspectConfig(smallWall, "wall.toml");
    ASSERT_TRUE(inspection.config) << allText(inspection.findings);
    EXPECT_TRUE(inspection.findings.empty()) << allText(inspection.findings);
    const Config& config = *inspection.config;
    EXPECT_EQ(config.name, "small");
    EXPECT_EQ(config.user.head, (Point{0, 1.7, 3}));
    ASSERT_EQ(config.screens.size(), 1U);
    EXPECT_EQ(config.screens[0].upperLeft, (Point{-1, 2, 0}));
    EXPECT_EQ(config.screens[0].tiles, (Cells{2, 1}));
    ASSERT_EQ(config.servers.size(), 2U);
    EXPECT_EQ(config.servers[1].name, "east");
    EXPECT_EQ(config.servers[1].host, "pc2");
    EXPECT_EQ(config.servers[1].port, defaultPort);
    EXPECT_EQ(config.servers[1].windows[0].size, (Cells{400, 400}));
    EXPECT_EQ(config.servers[1].windows[0].viewports[0].tile, (Cells{1, 0}));
    EXPECT_EQ(config.servers[1].windows[0].viewports[0].eye, Eye::mono);
}

// Every key once, none with its default.
constexpr const char* fullWall = R"(
name = "full \"wall\""
user = { head = [1, 2, 3], forward = [1, 0, -1], eye_separation = 0 }
[sync]
timeout = 0.25
start_timeout = 10
on_timeout = "wait"
pipeline = 2
[cluster]
key = "keys/wall.key"
launch = "ssh"
server = "/opt/gnomon/bin/gnomon-server"
options = ["-p", "2222"]
lookup = "239.1.2.3:9"
[shadow]
on = false
technique = "lispsm+evsm"
map_size = 16384
color = [0.1, 0.2, 0.3, 0.4]
offset_bias = 4
offset_factor = 10.5
range = 0.79
cascades = 8
quality_mode = true
depth_range = "previous"
[render]
samples = 8
background = [0.1, 0.2, 0.3]
near = 1e-7
far = 123456789.125
foreground = { image = "logo.png", position = [0.5, 0.25], height = 0.3 }
[[screen]]
name = "s"
lower_left = [-1.0, 1.0, -1]
lower_right = [1.0, 1.0, -1]
upper_left = [-1.0, 2.0, -1]
tiles = [1, 2]
overlap = [0, 10]
[[server]]
name = "a"
host = "10.0.0.1"
port = 9000
gpu = 1
[[server.window]]
size = [900, 400]
position = [7, -9]
fullscreen = true
monitor = 2
gpu = 0
[[server.window.viewport]]
screen = "s"
tile = [0, 1]
eye = "right"
rect = [100, 0.25, 400, 0.25]
[[server.window.viewport]]
screen = "s"
eye = "left"
rect = [0.5555555555555556, 0, 400, 100]
[[screen]]
name = "t"
lower_left = [-1, 1, -1]
lower_right = [1, 1, -1]
upper_left = [-1, 1.5, -1]
bezel = [0.01, 0.02]
[[server_grid]]
screen = "t"
eyes = ["left"]
name = "grid{row}"
window = [400, 100]
)";

TEST(Load, EveryKeySurvivesBeingWrittenAndRead) {
    const Inspection inspection = inspectConfig(fullWall, "wall.toml");
    ASSERT_TRUE(inspection.config) << allText(inspection.findings);
    const Config& config = *inspection.config;
    EXPECT_EQ(config.name, "full \"wall\"");
    EXPECT_EQ(config.cluster.launch, Launch::ssh);
    EXPECT_EQ(config.cluster.options, (std::vector<std::string>{"-p", "2222"}));
    EXPECT_EQ(config.shadow.offsetFactor, 10.5);
    EXPECT_EQ(config.render.background[1], (Colour{0.1, 0.2, 0.3}));
    EXPECT_EQ(config.render.near, 1e-7);
    ASSERT_TRUE(config.render.foreground);
    EXPECT_EQ(config.render.foreground->height, 0.3);
    EXPECT_EQ(gpuOf(config.servers[0], config.servers[0].windows[0]), 0);

    const auto again = parseConfig(toToml(config), "written.toml");
    ASSERT_TRUE(again) << again.error().text() << "\n" << toToml(config);
    EXPECT_EQ(*again, config);
}

TEST(Load, ServersWithoutAHostAreLookedUpWhereTheWallSaysSo) {
    const auto servers = [](const std::string& lookup, const std::string& host) {
        auto text = replaced(smallWall, "host = \"pc2\"\n", host);
        text = replaced(text, "[shadow]\n", "[cluster]\n" + lookup + "[shadow]\n");
        text +=
            "[[screen]]\nname = \"side\"\nlower_left = [-1, 1, -1]\nlower_right = [1, 1, -1]\n"
            "upper_left = [-1, 2, -1]\n[[server_grid]]\nscreen = \"side\"\nwindow = [64, 64]\n";
        const auto config = parseConfig(text, "wall.toml");
        EXPECT_TRUE(config) << config.error().text();
        const auto again = parseConfig(toToml(*config), "written.toml");
        EXPECT_TRUE(again) << again.error().text();
        EXPECT_EQ(*again, *config);
        return config->servers;
    };
    const std::string on = "lookup = \"239.255.74.30:7430\"\n";
    const auto found = servers(on, "");
    EXPECT_FALSE(isLookedUp(found[0]));
    EXPECT_EQ(found[0].port, defaultPort);
    for (const auto i : {1U, 2U}) {
        EXPECT_TRUE(isLookedUp(found[i])) << i;
        EXPECT_EQ(found[i].port, 0) << i;
    }
    EXPECT_EQ(servers(on, "host = \"localhost\"\n")[1].host, "localhost");
    for (const auto i : {1U, 2U}) EXPECT_EQ(servers("", "")[i].host, "localhost") << i;
}

TEST(Load, TheKeyIsLookedForBesideTheWall) {
    const auto keyOf = [](const std::string& line) {
        const auto text = replaced(smallWall, "[shadow]\n", "[cluster]\n" + line + "[shadow]\n");
        const auto config = parseConfig(text, "/walls/a/wall.toml");
        return config ? keyPath(config->cluster) : config.error().what;
    };
    EXPECT_EQ(keyOf("key = \"wall.key\"\n"), "/walls/a/wall.key");
    EXPECT_EQ(keyOf("key = \"/etc/wall.key\"\n"), "/etc/wall.key");
    EXPECT_EQ(keyOf(""), "");
}

TEST(Load, WhatIsWrittenDiffersWhenAnyValueDoes) {
    // Guards the round trip tests: == must not be blind to what origins hide.
    const Config config = *parseConfig(smallWall, "wall.toml");
    Config other = config;
    other.servers[1].windows[0].viewports[0].rect[2] = 0.5;
    EXPECT_NE(other, config);
    EXPECT_NE(toToml(other), toToml(config));
    other = config;
    other.servers[1].origin = {};
    EXPECT_EQ(other, config);
}

TEST(Load, WindowsOfThisMachineLieAsOnTheWall) {
    std::string text = replaced(smallWall, "pc1", "localhost");
    text = replaced(text, "pc2", "127.0.0.1");
    const auto config = parseConfig(text, "wall.toml");
    ASSERT_TRUE(config) << config.error().text();
    EXPECT_EQ(config->servers[0].port, 0);
    EXPECT_EQ(config->servers[0].windows[0].position, (Cells{0, 0}));
    EXPECT_EQ(config->servers[1].windows[0].position, (Cells{400, 0}));
    const auto placed =
        parseConfig(replaced(text,
                             "tile = [0, 0]\n[[server]]\nname = \"east\"\nhost = "
                             "\"127.0.0.1\"\n[[server.window]]\n",
                             "tile = [0, 0]\n[[server]]\nname = \"east\"\nhost = "
                             "\"127.0.0.1\"\n[[server.window]]\nposition = [3, 4]\n"),
                    "wall.toml");
    ASSERT_TRUE(placed) << placed.error().text();
    EXPECT_EQ(placed->servers[1].windows[0].position, (Cells{3, 4}));
}

TEST(Load, AFileThatIsNotThereIsAFileError) {
    const auto config = loadConfig("no/such/wall.toml");
    ASSERT_FALSE(config);
    EXPECT_EQ(config.error().code, Errc::file);
    EXPECT_NE(config.error().text().find("no/such/wall.toml"), std::string::npos);
    const auto folder = loadConfig(GNOMON_SOURCE_DIR);
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().code, Errc::file);
    EXPECT_NE(folder.error().text().find("folder"), std::string::npos);
}

TEST(Load, ImagesLieBesideTheFile) {
    std::string text = replaced(smallWall, "[[screen]]",
                                "[render.foreground]\nimage = \"a/logo.png\"\n[[screen]]");
    const auto config = parseConfig(text, "walls/wall.toml");
    ASSERT_TRUE(config) << config.error().text();
    EXPECT_EQ(imagePath(*config->render.foreground), "walls/a/logo.png");
}

}  // namespace
}  // namespace gnomon::config
