#include <gtest/gtest.h>

#include <numbers>

#include "ViewOptions.h"

namespace gnomon::client {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Parsed {
    ViewArguments view = {};
    std::vector<LightOption> lights = {};
    ShadowArguments shadow = {};
    std::string backend = {};
};

Parsed parse(std::vector<std::string> words) {
    CLI::App app;
    Parsed parsed;
    addViewOptions(app, parsed.view);
    addLightOptions(app, parsed.lights);
    addShadowOptions(app, parsed.shadow);
    addBackendOption(app, parsed.backend);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app.parse(words);
    parsed.view.validate();
    return parsed;
}

TEST(ViewOptions, AreReadInTheirUnits) {
    const auto parsed = parse({"--size", "640x480", "--eye", "-1,2.5,3e1", "--center", "0,0,0",
                               "--up", "0,0,1", "--fovy", "90", "--near", "0.1", "--far", "100"});
    EXPECT_EQ(parsed.view.size, (std::array<int, 2>{640, 480}));
    const auto look = parsed.view.look();
    ASSERT_TRUE(look);
    EXPECT_EQ(look->eye, (math::dvec3{-1.0, 2.5, 30.0}));
    EXPECT_EQ(look->up, (math::dvec3{0.0, 0.0, 1.0}));
    EXPECT_EQ(look->scale, 1.0);
    EXPECT_DOUBLE_EQ(*parsed.view.fovy, std::numbers::pi / 2);
    EXPECT_EQ(parsed.view.near, 0.1);
    EXPECT_EQ(parsed.view.far, 100.0);
}

TEST(ViewOptions, WithoutEyeHaveNoLook) { EXPECT_FALSE(parse({"--size", "1x1"}).view.look()); }

TEST(ViewOptions, LightsMayComeSeveralTimes) {
    const auto lights = parse({"--sun", "0,1,0", "--spot", "1,2,3,0,-1,0,40,0.5", "--sun",
                               "1,0,0,0.25", "--point", "4,5,6,0.1"})
                            .lights;
    ASSERT_EQ(lights.size(), 4U);
    EXPECT_EQ(std::get<Sun>(lights[0]), (Sun{.toward = {0, 1, 0}}));
    EXPECT_EQ(std::get<Sun>(lights[1]), (Sun{.toward = {1, 0, 0}, .angle = 0.25 * degree}));
    EXPECT_EQ(
        std::get<Spot>(lights[2]),
        (Spot{
            .position = {1, 2, 3}, .direction = {0, -1, 0}, .angle = 40 * degree, .radius = 0.5}));
    EXPECT_EQ(std::get<Point>(lights[3]), (Point{.position = {4, 5, 6}, .radius = 0.1}));
}

TEST(ViewOptions, TechniqueAndMapSizeReplaceTheConfigs) {
    config::Shadow shadow{.on = false, .mapSize = 512};
    parse({"--technique", "trapez+pcf", "--map-size", "4096", "--depth-range", "previous"})
        .shadow.apply(shadow);
    EXPECT_TRUE(shadow.on);
    EXPECT_EQ(shadow.technique, "trapez+pcf");
    EXPECT_EQ(shadow.mapSize, 4096);
    EXPECT_EQ(shadow.depthRange, config::DepthRange::previous);
}

struct WrongCase {
    const char* name;
    std::vector<std::string> words;
    const char* said;  // a part of the message
};

class WrongOption : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongOption, IsRefusedWithWhatWasExpected) {
    try {
        parse(GetParam().words);
        FAIL() << "accepted";
    } catch (const CLI::ParseError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find(GetParam().said), std::string::npos) << text;
        EXPECT_NE(text.find(GetParam().words[0]), std::string::npos) << text;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Table, WrongOption,
    testing::Values(
        WrongCase{"TwoNumbers", {"--eye", "1,2", "--center", "0,0,0"}, "three numbers: x,y,z"},
        WrongCase{"FourNumbers", {"--eye", "1,2,3,4", "--center", "0,0,0"}, "three numbers"},
        WrongCase{"NoNumber", {"--eye", "1,2,z", "--center", "0,0,0"}, "found \"1,2,z\""},
        WrongCase{"Blank", {"--eye", "1, 2,3", "--center", "0,0,0"}, "three numbers"},
        WrongCase{"TrailingComma", {"--eye", "1,2,3,", "--center", "0,0,0"}, "three numbers"},
        WrongCase{"Infinite", {"--eye", "inf,0,0", "--center", "0,0,0"}, "three numbers"},
        WrongCase{"NotANumber", {"--eye", "nan,0,0", "--center", "0,0,0"}, "three numbers"},
        WrongCase{"EyeAlone", {"--eye", "1,2,3"}, "together"},
        WrongCase{"CenterAlone", {"--center", "1,2,3"}, "together"},
        WrongCase{"UpAlone", {"--up", "0,1,0"}, "needs --eye"},
        WrongCase{"SamePoint", {"--center", "1,2,3", "--eye", "1,2,3"}, "same point"},
        WrongCase{"ZeroUp", {"--up", "0,0,0"}, "not 0,0,0"},
        WrongCase{"SizeWithoutX", {"--size", "640"}, "WxH"},
        WrongCase{"SizeNegative", {"--size", "640x-1"}, "WxH"},
        WrongCase{"SizeHuge", {"--size", "70000x1"}, "65535"},
        WrongCase{"SizeFraction", {"--size", "640.5x480"}, "WxH"},
        WrongCase{"FovyWide", {"--fovy", "180"}, "below 180"},
        WrongCase{"FovyZero", {"--fovy", "0"}, "above 0"},
        WrongCase{"NearZero", {"--near", "0"}, "above 0"},
        WrongCase{"NearBeyondFar", {"--near", "2", "--far", "1"}, "less than --far"},
        WrongCase{"SunOfTwo", {"--sun", "0,1"}, "x,y,z[,ANGLE]"},
        WrongCase{"SunNowhere", {"--sun", "0,0,0"}, "not 0,0,0"},
        WrongCase{"SunAngle", {"--sun", "0,1,0,90"}, "below 90"},
        WrongCase{"SpotOfSix", {"--spot", "1,2,3,4,5,6"}, "px,py,pz,dx,dy,dz,ANGLE[,RADIUS]"},
        WrongCase{"SpotAngle", {"--spot", "0,0,0,0,-1,0,180"}, "between 0 and 180"},
        WrongCase{"SpotRadius", {"--spot", "0,0,0,0,-1,0,30,-1"}, "radius"},
        WrongCase{"PointOfFive", {"--point", "1,2,3,4,5"}, "px,py,pz[,RADIUS]"},
        WrongCase{"Technique", {"--technique", "sdt"}, "sdt"},
        WrongCase{"MapSizeWord", {"--map-size", "big"}, "whole number"},
        WrongCase{"MapSizeTiny", {"--map-size", "1"}, "1"},
        WrongCase{"Backend", {"--backend", "vulkan"}, "egl, osmesa, glfw, none or auto"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gnomon::client
