#include <gnomon/client/SceneTree.h>
#include <gnomon/client/WallSetup.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Load.h>
#include <gnomon/image/Png.h>
#include <gnomon/scene/CameraView.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "Imported.h"

namespace gnomon::client {
namespace {

using field::Ref;

config::Config wallOf(const std::string& name) {
    return orThrow(config::loadConfig(std::string{GNOMON_SOURCE_DIR "/configs/"} + name));
}

class EveryWall : public testing::TestWithParam<std::string> {
protected:
    config::Config config = wallOf(GetParam());
    field::TypeRegistry types = test::sceneTypes();
    field::Aspect aspect{types, 2};
    SceneTree tree = makeSceneTree(aspect);

    scene::CameraView viewOf(Ref<scene::Viewport> ref) const {
        return orThrow(scene::cameraView(aspect, aspect.get(ref)->camera, 1.0));
    }
};

/// Largest difference of two matrices, in the units of the larger one's largest element.
double difference(const math::dmat4& a, const math::dmat4& b) {
    double largest = 0.0, size = 0.0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
            size = std::max({size, std::abs(a[c][r]), std::abs(b[c][r])});
        }
    return largest / size;
}

TEST_P(EveryWall, EachViewportLooksThroughItsPartOfItsScreen) {
    const auto wall = orThrow(buildWall(aspect, config, tree.root));
    setView(aspect, wall, config, {.eye = {3, 4, 5}, .center = {0, 1, 0}, .scale = 2.0});
    std::size_t window = 0;
    for (const auto& server : config.servers) {
        for (const auto& described : server.windows) {
            const auto* made = aspect.get(wall.windows[window++]);
            EXPECT_EQ(made->server.get(), server.name);
            EXPECT_EQ(made->size.get(), (glm::ivec2{described.size[0], described.size[1]}));
            ASSERT_EQ(made->viewports.size(), described.viewports.size());
            for (std::size_t i = 0; i < described.viewports.size(); ++i) {
                const auto& from = described.viewports[i];
                const auto screen = *config::screenIndex(config, from.screen);
                const auto canvas = orThrow(config::canvas(config, screen));
                const auto tile = canvas.tile(from.tile[0], from.tile[1]);
                const auto view = viewOf(made->viewports[i]);
                EXPECT_NEAR(view.part.width * canvas.width, tile.width, 1e-9);
                EXPECT_NEAR(view.part.height * canvas.height, tile.height, 1e-9);
                EXPECT_NEAR(view.part.left * canvas.width, tile.x, 1e-9);
                EXPECT_EQ(view.group.id, wall.screens[screen].id);
                EXPECT_LT(difference(view.view.clipFromEye,
                                     math::tileFromWhole(view.part) * view.whole.clipFromEye),
                          1e-12);
                EXPECT_EQ(view.view.eyeFromWorld, view.whole.eyeFromWorld);
                const auto pixels =
                    scene::pixelRect(aspect.get(made->viewports[i])->rect, made->size);
                EXPECT_EQ(pixels.width, tile.width);
                EXPECT_EQ(pixels.height, tile.height);
            }
        }
    }
}

TEST_P(EveryWall, TheWholeScreenIsWhatItsTilesAreCutFrom) {
    const auto wall = orThrow(buildWall(aspect, config, tree.root));
    const Look look{.eye = {0, 2, 9}, .center = {0, 1, 0}};
    setView(aspect, wall, config, look);
    field::Aspect other{types, 2};
    const auto otherTree = makeSceneTree(other);
    for (std::size_t screen = 0; screen < config.screens.size(); ++screen) {
        const auto eyes = eyesOf(config, screen);
        const auto whole =
            orThrow(buildWholeScreen(other, config, screen, eyes, otherTree.root, "shot"));
        setView(other, whole, config, look);
        const auto* window = other.get(whole.windows[0]);
        const auto canvas = orThrow(config::canvas(config, screen));
        EXPECT_EQ(window->size.get(),
                  (glm::ivec2{canvas.width * static_cast<int>(eyes.size()), canvas.height}));
        for (std::size_t i = 0; i < wall.viewports.size(); ++i) {
            const auto tile = viewOf(wall.viewports[i]);
            if (tile.group.id != wall.screens[screen].id) continue;
            // The same eye: the same whole view, bit for bit.
            int same = 0;
            for (const auto& viewport : whole.viewports) {
                const auto view =
                    orThrow(scene::cameraView(other, other.get(viewport)->camera, 1.0));
                if (view.view.eyeFromWorld == tile.whole.eyeFromWorld &&
                    view.view.clipFromEye == tile.whole.clipFromEye)
                    ++same;
            }
            EXPECT_EQ(same, 1);
        }
    }
}

TEST_P(EveryWall, HeadLandsAtTheEyeAndLooksToTheCenter) {
    const Look look{.eye = {3, 4, 5}, .center = {-1, 2, 0}, .scale = 0.5};
    const auto world = math::toMatrix(worldFromRoom(config, look));
    const auto& head = config.user.head;
    const math::dvec3 at{world * math::dvec4{head[0], head[1], head[2], 1.0}};
    EXPECT_LT(glm::length(at - look.eye), 1e-6);
    const math::dvec3 ahead{world * math::dvec4{0, 0, -1, 0}};
    EXPECT_NEAR(glm::length(ahead), 0.5, 1e-6);
    EXPECT_LT(glm::length(glm::normalize(ahead) - glm::normalize(look.center - look.eye)), 1e-6);
}

std::vector<std::string> wallFiles() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{GNOMON_SOURCE_DIR "/configs"})
        if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

INSTANTIATE_TEST_SUITE_P(Configs, EveryWall, testing::ValuesIn(wallFiles()), [](const auto& row) {
    std::string name = row.param.substr(0, row.param.find('.'));
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
});

TEST(WallSetup, ConfigsNearAndFarComeFirst) {
    auto config = wallOf("local-2x2.toml");
    config.render.near = 0.25;
    const auto types = test::sceneTypes();
    field::Aspect aspect{types, 2};
    const auto tree = makeSceneTree(aspect);
    const auto wall = orThrow(buildWall(aspect, config, tree.root));
    setDepthRange(aspect, wall, config, {.near = 5.0, .far = 50.0});
    EXPECT_EQ(aspect.get(wall.lens)->near, 0.25);
    EXPECT_EQ(aspect.get(wall.lens)->far, 50.0);
    setDepthRange(aspect, wall, config, {.near = 0.01, .far = 0.1});
    EXPECT_LT(aspect.get(wall.lens)->near, aspect.get(wall.lens)->far);
}

TEST(WallSetup, ShadowsAreAsTheConfigSays) {
    auto config = wallOf("local-2x2.toml");
    config.shadow.technique = "lispsm+pcf";
    config.shadow.mapSize = 2048;
    config.shadow.offsetFactor = 3.0;
    const auto types = test::sceneTypes();
    field::Aspect aspect{types, 2};
    const auto wall = orThrow(buildWall(aspect, config, makeSceneTree(aspect).root));
    ASSERT_EQ(wall.viewports.size(), 4U);
    for (const auto& ref : wall.viewports) {
        const auto* viewport = aspect.get(ref);
        EXPECT_EQ(viewport->technique.get(), "lispsm+pcf");
        EXPECT_EQ(viewport->mapSize, 2048);
        EXPECT_TRUE(viewport->overrideBias);
        EXPECT_EQ(viewport->offFactor, 3.0F);
        EXPECT_EQ(viewport->offBias, 4.0F);
    }
}

// The image lies across the border of two tiles; each draws it at its own place, in its pixels.
TEST(WallSetup, TheForegroundGoesOnAcrossTiles) {
    const auto file = testing::TempDir() + "gnomon-logo-" + std::to_string(::getpid()) + ".png";
    orThrow(image::writePng(file, image::blank(40, 10, 4)));
    config::Config config;
    config.render.foreground =
        config::Foreground{.image = file, .position = {0.4, 0.5}, .height = 0.1};
    config.screens.push_back({.name = "front",
                              .lowerLeft = {-1, 0, 0},
                              .lowerRight = {1, 0, 0},
                              .upperLeft = {-1, 1, 0},
                              .tiles = {2, 1}});
    for (int column = 0; column < 2; ++column)
        config.servers.push_back(
            {.name = std::to_string(column),
             .windows = {
                 {.size = {100, 100}, .viewports = {{.screen = "front", .tile = {column, 0}}}}}});
    const auto types = test::sceneTypes();
    field::Aspect aspect{types, 2};
    const auto wall = orThrow(buildWall(aspect, config, makeSceneTree(aspect).root));
    const std::array<double, 2> lefts{80.0, -20.0};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& foregrounds = aspect.get(wall.viewports[i])->foregrounds;
        ASSERT_EQ(foregrounds.size(), 1U);
        const auto* logo = aspect.get(Ref<scene::ImageForeground>{foregrounds[0].id});
        ASSERT_NE(logo, nullptr);
        EXPECT_EQ(logo->rect.get(),
                  (math::Rect{.left = lefts[i], .bottom = 50, .width = 40, .height = 10}));
        EXPECT_EQ(aspect.get(logo->image.get())->pixels->size(), 40U * 10U * 4U);
    }
    std::filesystem::remove(file);
}

TEST(WallSetup, OpeningIsWhatTheHeadSees) {
    config::Config config;
    config.user.head = {0.5, 1.0, 2.0};
    config.screens.push_back({.name = "front",
                              .lowerLeft = {-1, 0, 0},
                              .lowerRight = {1, 0, 0},
                              .upperLeft = {-1, 2, 0}});
    const Opening expected{.left = -0.75, .right = 0.25, .bottom = -0.5, .top = 0.5};
    EXPECT_EQ(wallOpening(config), expected);
    EXPECT_EQ(wallDistance(config), 2.0);
    // A side wall of a cave, which begins beside the head, adds nothing.
    config.screens.push_back({.name = "left",
                              .lowerLeft = {-1, 0, 4},
                              .lowerRight = {-1, 0, 0},
                              .upperLeft = {-1, 2, 4}});
    EXPECT_EQ(wallOpening(config), expected);
    EXPECT_EQ(wallDistance(config), 2.0);
}

}  // namespace
}  // namespace gnomon::client
