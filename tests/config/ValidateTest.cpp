#include <gtest/gtest.h>

#include <limits>

#include "Walls.h"

namespace gnomon::config {
namespace {

TEST(Validate, DefaultsAreRight) {
    EXPECT_TRUE(validate(User{}).empty());
    EXPECT_TRUE(validate(Sync{}).empty());
    EXPECT_TRUE(validate(Shadow{}).empty());
    EXPECT_TRUE(validate(Render{}).empty());
    EXPECT_FALSE(validate(Screen{}).empty()) << "a screen without corners";
    EXPECT_FALSE(validate(Server{}).empty()) << "a server without a window";
}

TEST(Validate, KnowsNoNumberThatIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity}) {
        EXPECT_FALSE(validate(User{.head = {0, bad, 0}}).empty());
        EXPECT_FALSE(validate(User{.forward = {bad, 0, 0}}).empty());
        EXPECT_FALSE(validate(User{.eyeSeparation = bad}).empty());
        EXPECT_FALSE(validate(Sync{.timeout = bad}).empty());
        EXPECT_FALSE(validate(Shadow{.range = bad}).empty());
        EXPECT_FALSE(validate(Shadow{.offsetBias = bad}).empty());
        EXPECT_FALSE(validate(Render{.far = bad}).empty());
    }
}

TEST(Validate, SaysWhatWithoutAPosition) {
    const auto findings = validate(Shadow{.technique = "pfc"});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].text().rfind("shadow: technique is \"pfc\", must be \"std\"", 0), 0U);
    EXPECT_NE(findings[0].text().find("did you mean \"pcf\"?"), std::string::npos);
}

TEST(Validate, TechniquesAreThoseOfTheCommandLine) {
    for (const char* good :
         {"none",      "volume",     "planar",      "blob",       "lightmap",
          "ray",       "auto",       "std",         "trapez",     "psm",
          "lispsm",    "csm",        "cube",        "paraboloid", "sparse",
          "pcf",       "ppcf",       "vsm",         "std+hard",   "csm+pcf",
          "cube+ppcf", "trapez+vsm", "lispsm+evsm", "std+square", "lispsm+gauss"}) {
        EXPECT_TRUE(validate(Shadow{.technique = good}).empty()) << good;
    }
    for (const char* bad : {"", "+", "std+", "+pcf", "none+pcf", "pcf+pcf", "std+pcf+vsm", "hard",
                            "evsm", "STD", "std pcf", "std+none"}) {
        EXPECT_FALSE(validate(Shadow{.technique = bad}).empty()) << bad;
    }
}

TEST(Validate, CornersMayBeOffARightAngleByWhatMeasuringGives) {
    Screen screen{.name = "s", .lowerRight = {2, 0, 0}, .upperLeft = {0.003, 2, 0}};
    EXPECT_TRUE(validate(screen).empty());  // 0.086 degrees
    screen.upperLeft[0] = 0.004;            // 0.115 degrees
    EXPECT_FALSE(validate(screen).empty());
}

TEST(Validate, AServerThatIsLookedUpTellsItsPortItself) {
    const auto textOf = [](int port) {
        return allText(validate(Server{.name = "east", .host = "", .port = port}));
    };
    EXPECT_NE(textOf(7430).find("server \"east\": port is 7430, and a server without a host says"),
              std::string::npos)
        << textOf(7430);
    EXPECT_EQ(textOf(0).find("port"), std::string::npos) << textOf(0);
}

TEST(IsLocal, KnowsThisMachine) {
    for (const char* host : {"localhost", "127.0.0.1", "127.0.1.1", "::1"}) {
        EXPECT_TRUE(isLocal(host)) << host;
    }
    for (const char* host : {"", "localhost.example", "pc", "127.example.org", "10.127.0.1"}) {
        EXPECT_FALSE(isLocal(host)) << host;
    }
}

}  // namespace
}  // namespace gnomon::config
