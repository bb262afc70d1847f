#include <gtest/gtest.h>

#include <numbers>

#include "bench/ViewFile.h"

namespace gnomon::client {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

TEST(ViewFile, SaysWhatTheCommandLineSays) {
    const auto views = parseViews(
        "# views of the grove\n"
        "\n"
        "{\"name\": \"side\", \"scene\": \"grove\", \"eye\": [0, 3.5, 30], \"center\": [0, 1, -2], "
        "\"up\": [0, 0, 1], \"fovy\": 60, \"near\": 0.1, \"far\": 400, "
        "\"sun\": [0.5, 0.8, 0.35, 0.27]}\r\n"
        "{\"name\": \"lamps\", \"point\": [[1, 2, 3], [4, 5, 6, 0.5]], "
        "\"spot\": [0, 9, 0, 0, -1, 0, 40]}",
        "views.jsonl");
    ASSERT_TRUE(views) << views.error().what;
    ASSERT_EQ(views->size(), 2U);
    const BenchView& side = (*views)[0];
    EXPECT_EQ(side.name, "side");
    EXPECT_EQ(side.scene, "grove");
    EXPECT_EQ(side.view.eye, (math::dvec3{0, 3.5, 30}));
    EXPECT_EQ(side.view.center, (math::dvec3{0, 1, -2}));
    EXPECT_EQ(side.view.up, (math::dvec3{0, 0, 1}));
    EXPECT_DOUBLE_EQ(*side.view.fovy, 60 * degree);
    EXPECT_EQ(side.view.near, 0.1);
    EXPECT_EQ(side.view.far, 400.0);
    ASSERT_EQ(side.lights.size(), 1U);
    EXPECT_EQ(std::get<Sun>(side.lights[0]),
              (Sun{.toward = {0.5, 0.8, 0.35}, .angle = 0.27 * degree}));
    const BenchView& lamps = (*views)[1];
    EXPECT_FALSE(lamps.view.eye);
    ASSERT_EQ(lamps.lights.size(), 3U);
    EXPECT_EQ(std::get<Point>(lamps.lights[2]), (Point{.position = {4, 5, 6}, .radius = 0.5}));
}

struct WrongFile {
    const char* name;
    const char* text;
    const char* said;
};

class WrongViewFile : public testing::TestWithParam<WrongFile> {};

TEST_P(WrongViewFile, IsRefusedWithFileAndLine) {
    const auto views = parseViews(GetParam().text, "v.jsonl");
    ASSERT_FALSE(views) << "accepted";
    EXPECT_EQ(views.error().code, Errc::file);
    EXPECT_NE(views.error().what.find(GetParam().said), std::string::npos) << views.error().what;
    EXPECT_EQ(views.error().what.find('\n'), std::string::npos) << "one line";
}

INSTANTIATE_TEST_SUITE_P(
    Table, WrongViewFile,
    testing::Values(
        WrongFile{"Nothing", "# only this\n", "v.jsonl: no line with a view"},
        WrongFile{"NoJson", "{\"name\": \"a\"}\nname = b\n", "v.jsonl:2: expected a JSON object"},
        WrongFile{"List", "[1, 2]", "v.jsonl:1: expected a JSON object"},
        WrongFile{"CutShort", "\n\n{\"name\": \"a\"", "v.jsonl:3: expected a JSON object"},
        WrongFile{"NoName", "{\"fovy\": 60}", "v.jsonl:1: \"name\" is missing"},
        WrongFile{"EmptyName", "{\"name\": \"\"}", "v.jsonl:1: \"name\": found \"\""},
        WrongFile{"UnknownKey", "{\"name\": \"a\", \"fov\": 60}", "v.jsonl:1: unknown key \"fov\""},
        WrongFile{"Size", "{\"name\": \"a\", \"size\": [1, 2]}", "unknown key \"size\""},
        WrongFile{"Twice", "{\"name\": \"a\"}\n{\"name\": \"a\"}",
                  "v.jsonl:2: a view called \"a\""},
        WrongFile{"TextForNumber", "{\"name\": \"a\", \"fovy\": \"60\"}",
                  "v.jsonl:1: \"fovy\": found \"60\", expected numbers"},
        WrongFile{"TwoNumbers", "{\"name\": \"a\", \"eye\": [1, 2], \"center\": [0, 0, 0]}",
                  "v.jsonl:1: --eye: found \"1,2\""},
        WrongFile{"EyeAlone", "{\"name\": \"a\", \"eye\": [1, 2, 3]}", "together"},
        WrongFile{"Wide", "{\"name\": \"a\", \"fovy\": 190}", "v.jsonl:1: --fovy"},
        WrongFile{"NearBeyondFar", "{\"name\": \"a\", \"near\": 2, \"far\": 1}",
                  "v.jsonl:1: --near"},
        WrongFile{"SunOfTwo", "{\"name\": \"a\", \"sun\": [1, 2]}", "v.jsonl:1: --sun"},
        WrongFile{"SunsOfTwo", "{\"name\": \"a\", \"sun\": [[0, 1, 0], [1, 2]]}", "--sun"},
        WrongFile{"MixedSuns", "{\"name\": \"a\", \"sun\": [[0, 1, 0], 5]}", "expected numbers"},
        WrongFile{"NoNumbers", "{\"name\": \"a\", \"sun\": []}", "expected numbers"}),
    [](const auto& row) { return row.param.name; });

TEST(ViewFile, AFileThatIsNotThereIsNamed) {
    const auto views = loadViews("/no/such/views.jsonl");
    ASSERT_FALSE(views);
    EXPECT_NE(views.error().text().find("/no/such/views.jsonl"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::client
