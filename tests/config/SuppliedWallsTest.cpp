#include <gnomon/config/Adjust.h>
#include <gnomon/config/Layout.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "Walls.h"

namespace gnomon::config {
namespace {

std::vector<std::string> suppliedWalls() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator{GNOMON_SOURCE_DIR "/configs"}) {
        if (entry.path().extension() == ".toml") paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::string wallName(const testing::TestParamInfo<std::string>& info) {
    std::string name = std::filesystem::path{info.param}.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

class SuppliedWall : public testing::TestWithParam<std::string> {};

TEST_P(SuppliedWall, LoadsWithoutAnyFinding) {
    const auto inspection = inspectFile(GetParam());
    ASSERT_TRUE(inspection) << inspection.error().text();
    EXPECT_EQ(allText(inspection->findings), "");
    EXPECT_TRUE(inspection->config);
}

TEST_P(SuppliedWall, IsTheSameAfterBeingWrittenAndRead) {
    const auto config = loadConfig(GetParam());
    ASSERT_TRUE(config) << config.error().text();
    const auto again = parseConfig(toToml(*config), "written.toml");
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(*again, *config);
    EXPECT_EQ(toToml(*again), toToml(*config));
}

TEST_P(SuppliedWall, RunsOnOneMachineWithSmallTiles) {
    const auto config = loadConfig(GetParam());
    ASSERT_TRUE(config) << config.error().text();
    const auto& tile = config->servers.front().windows.front().size;
    const auto small = withTileSize(*config, tile[0] / 4, tile[1] / 4);
    ASSERT_TRUE(small) << small.error().text();
    const Config local = localized(*small);
    EXPECT_EQ(allText(findings(local)), "");
    EXPECT_EQ(local.servers.size(), config->servers.size());
    const auto again = parseConfig(toToml(local), "written.toml");
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(*again, local);
}

TEST_P(SuppliedWall, IsDescribedAndDrawnServerByServer) {
    const auto config = loadConfig(GetParam());
    ASSERT_TRUE(config) << config.error().text();
    const std::string text = describe(*config);
    const std::string picture = svg(*config);
    for (const Server& server : config->servers) {
        EXPECT_NE(text.find("\n" + server.name + " "), std::string::npos) << server.name;
        EXPECT_NE(picture.find(">" + server.name + "<"), std::string::npos) << server.name;
    }
}

INSTANTIATE_TEST_SUITE_P(All, SuppliedWall, testing::ValuesIn(suppliedWalls()), wallName);

TEST(SuppliedWalls, HaveTheServersTheirNamesPromise) {
    const auto servers = [](const char* name) {
        const auto config = loadConfig(std::string{GNOMON_SOURCE_DIR "/configs/"} + name);
        return config ? config->servers.size() : 0U;
    };
    EXPECT_EQ(servers("local-stereo.toml"), 2U);
    EXPECT_EQ(servers("local-2x2.toml"), 4U);
    EXPECT_EQ(servers("local-4x1.toml"), 4U);
    EXPECT_EQ(servers("local-2x2-stereo.toml"), 8U);
    EXPECT_EQ(servers("named-2x1.toml"), 2U);
    EXPECT_EQ(servers("wall-6x4-stereo.toml"), 48U);
    EXPECT_EQ(servers("cave-4.toml"), 8U);
}

TEST(SuppliedWalls, TheLargeWallHidesEightPixelsBehindABezel) {
    const auto config = loadConfig(GNOMON_SOURCE_DIR "/configs/wall-6x4-stereo.toml");
    ASSERT_TRUE(config) << config.error().text();
    const auto grid = canvas(*config, 0);
    ASSERT_TRUE(grid) << grid.error().text();
    EXPECT_EQ(grid->gap, (Cells{8, 8}));
    EXPECT_EQ(grid->width, 6 * 1920 + 5 * 8);
    EXPECT_EQ(grid->height, 4 * 1200 + 3 * 8);
    EXPECT_NEAR(grid->pitch[0], 0.99 / 1920, 1e-6);
}

}  // namespace
}  // namespace gnomon::config
