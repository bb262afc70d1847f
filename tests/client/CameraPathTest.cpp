#include <gnomon/client/CameraPath.h>
#include <gtest/gtest.h>

namespace gnomon::client {
namespace {

TEST(CameraPath, IsLinearBetweenKeysAndHoldsTheEnds) {
    const auto path = orThrow(CameraPath::parse(
        "{\"time\": 1, \"eye\": [0,0,0], \"center\": [0,0,-1], \"up\": [0,1,0]}\n"
        "\n"
        "{\"time\": 3.0, \"eye\": [4,0,0], \"center\": [4,2,-1], \"speed\": 7}\r\n",
        "p.jsonl"));
    EXPECT_EQ(path.start(), 1.0);
    EXPECT_EQ(path.end(), 3.0);
    EXPECT_EQ(path.at(0.0).eye, (math::dvec3{0, 0, 0}));
    EXPECT_EQ(path.at(2.0).eye, (math::dvec3{2, 0, 0}));
    EXPECT_EQ(path.at(2.5).center, (math::dvec3{3, 1.5, -1}));
    EXPECT_EQ(path.at(9.0).center, (math::dvec3{4, 2, -1}));
    EXPECT_EQ(path.at(2.0).up, (math::dvec3{0, 1, 0}));
}

struct WrongPath {
    const char* name;
    const char* text;
    const char* said;
};
class BrokenPath : public testing::TestWithParam<WrongPath> {};

TEST_P(BrokenPath, IsRefusedNamingTheLine) {
    const auto path = CameraPath::parse(GetParam().text, "p.jsonl");
    ASSERT_FALSE(path);
    EXPECT_NE(path.error().what.find(GetParam().said), std::string::npos) << path.error().what;
    EXPECT_EQ(path.error().what.rfind("p.jsonl:", 0), 0U) << path.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BrokenPath,
    testing::Values(
        WrongPath{"Empty", "\n\n", "no line with a camera"},
        WrongPath{"NotJson", "time 1", "p.jsonl:1: expected a JSON object"},
        WrongPath{"NoTime", "\n{\"eye\":[0,0,0],\"center\":[0,0,1]}", "p.jsonl:2: \"time\""},
        WrongPath{"NoEye", "{\"time\":0,\"center\":[0,0,1]}", "\"eye\" is missing"},
        WrongPath{"TwoNumbers", "{\"time\":0,\"eye\":[0,0],\"center\":[0,0,1]}", "three finite"},
        WrongPath{"Words", "{\"time\":0,\"eye\":[0,0,\"x\"],\"center\":[0,0,1]}", "three finite"},
        WrongPath{"Backwards",
                  "{\"time\":1,\"eye\":[0,0,0],\"center\":[0,0,1]}\n"
                  "{\"time\":1,\"eye\":[0,0,0],\"center\":[0,0,1]}",
                  "p.jsonl:2: time 1 does not come after 1"},
        WrongPath{"NoDirection", "{\"time\":0,\"eye\":[1,0,0],\"center\":[1,0,0]}",
                  "the same point"}),
    [](const auto& row) { return row.param.name; });

TEST(CameraPath, DeepNestingIsRefusedWithoutACrash) {
    EXPECT_FALSE(CameraPath::parse(std::string(200'000, '['), "p.jsonl"));
}

}  // namespace
}  // namespace gnomon::client
