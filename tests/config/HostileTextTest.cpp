#include <gtest/gtest.h>

#include <random>

#include "Walls.h"

namespace gnomon::config {
namespace {

std::string repeated(const std::string& part, std::size_t times) {
    std::string text;
    for (std::size_t i = 0; i < times; ++i) text += part;
    return text;
}

// Refused, with a position and without line breaks.
void expectRefused(const std::string& text) {
    const Inspection inspection = inspectConfig(text, "bad.toml");
    EXPECT_FALSE(inspection.config);
    ASSERT_FALSE(inspection.findings.empty());
    for (const Finding& finding : inspection.findings) {
        EXPECT_EQ(finding.text().rfind("bad.toml:", 0), 0U) << finding.text();
        EXPECT_EQ(finding.text().find('\n'), std::string::npos);
        EXPECT_LT(finding.text().size(), 1000U);
    }
}

TEST(HostileText, HundredKilobytesOfGarbageAreRefused) {
    std::mt19937 random{7};
    std::uniform_int_distribution<int> byte{0, 255};
    std::uniform_int_distribution<int> printable{32, 126};
    for (int round = 0; round < 5; ++round) {
        std::string bytes(100'000, '\0');
        for (char& c : bytes) c = static_cast<char>(byte(random));
        expectRefused(bytes);
        for (char& c : bytes) c = static_cast<char>(printable(random));
        expectRefused(bytes);
    }
}

TEST(HostileText, DeepNestingIsRefused) {
    expectRefused("a = " + repeated("[", 100'000));
    expectRefused("a = " + repeated("[", 50'000) + repeated("]", 50'000));
    expectRefused("a = " + repeated("{a = ", 20'000));
    expectRefused(repeated("a.", 400'000) + "a = 1");
    expectRefused("[" + repeated("a.", 400'000) + "a]");
    expectRefused("[[" + repeated("a.", 400'000) + "a]]");
    expectRefused("x = {" + repeated("a . ", 200'000) + "a = 1}");
    expectRefused(repeated("\"#'\" . ", 100'000) + "a = 1");
    expectRefused("x = '''\n'\n'''\n" + repeated("a.", 400'000) + "a = 1");
    expectRefused("x = \"\\\"\"\n" + repeated("a.", 400'000) + "a = 1");
    expectRefused("x = \"\"\"a\"\"\"\"\n" + repeated("a.", 400'000) + "a = 1");
}

TEST(HostileText, WhatTheTomlLibraryTakesForGrantedIsRefused) {
    for (const char* text : {"[=]",
                             "[.a]",
                             "[[=]]",
                             "[[a]=",
                             "a = [",
                             "a = {",
                             "[",
                             "[[",
                             "a.",
                             "a =",
                             "\"",
                             "'''",
                             "a = \"\\",
                             "a = 0x",
                             "a = 1_",
                             "a = +",
                             "a = 1e",
                             "a = 1-",
                             "a = \xd0\xa2",
                             "\xc2\xa0 = 1",
                             "a = \"\"\"x\\ \xd0\xa2\"\"\""}) {
        expectRefused(text);
    }
}

TEST(HostileText, LettersBeyondAsciiMayBeInQuotesAndComments) {
    const auto config =
        parseConfig(replaced(smallWall, "name = \"small\"",
                             "\xef\xbb\xbf# M\xc3\xbcnchen\nname = \"K\xc3\xb6ln\""),
                    "wall.toml");
    ASSERT_TRUE(config) << config.error().text();
    EXPECT_EQ(config->name, "K\xc3\xb6ln");
}

TEST(HostileText, DotsInTextsAndCommentsAreNoKeys) {
    const std::string dots(1000, '.');
    const std::string text =
        replaced(smallWall, "name = \"small\"",
                 "# " + dots + "\nname = \"" + std::string(200, '.') + "\" # " + dots);
    const auto config = parseConfig(text, "wall.toml");
    EXPECT_TRUE(config) << config.error().text();
}

TEST(HostileText, AFileAboveTheLimitIsRefusedUnread) {
    const Inspection inspection = inspectConfig(std::string(2'000'000, '\n'), "bad.toml");
    ASSERT_EQ(inspection.findings.size(), 1U);
    EXPECT_EQ(inspection.findings[0].what, "2000000 bytes, a wall description has at most 1048576");
}

TEST(HostileText, EveryTruncationOfAWallIsAnsweredOrRead) {
    const std::string text = smallWall;
    for (std::size_t length = 0; length < text.size(); ++length) {
        const Inspection inspection = inspectConfig(text.substr(0, length), "cut.toml");
        EXPECT_EQ(inspection.config.has_value(), !hasError(inspection.findings)) << length;
    }
}

TEST(HostileText, AWallWithAnyByteChangedIsAnsweredOrRead) {
    const std::string text = smallWall;
    std::mt19937 random{11};
    std::uniform_int_distribution<int> byte{0, 255};
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string changed = text;
        changed[at] = static_cast<char>(byte(random));
        const Inspection inspection = inspectConfig(changed, "changed.toml");
        EXPECT_EQ(inspection.config.has_value(), !hasError(inspection.findings)) << changed;
    }
}

TEST(HostileText, QuotedTextKeepsTheMessageOnOneLine) {
    const auto config =
        parseConfig(replaced(smallWall, "\"std\"", "\"st\\nd\\u0007\""), "wall.toml");
    ASSERT_FALSE(config);
    EXPECT_NE(config.error().what.find("\"st\\u000ad\\u0007\""), std::string::npos)
        << config.error().what;
}

TEST(HostileText, ManyGridsCannotMakeMoreServersThanAWallHas) {
    std::string text = replaced(smallWall, "tiles = [2, 1]", "tiles = [64, 64]");
    text += repeated("[[server_grid]]\nscreen = \"front\"\nwindow = [400, 400]\n", 1000);
    const Inspection inspection = inspectConfig(text, "wall.toml");
    ASSERT_EQ(inspection.findings.size(), 1000U);
    EXPECT_EQ(inspection.findings[0].what,
              "server_grid of screen \"front\": makes 4098 servers, a wall has at most 1024");
}

}  // namespace
}  // namespace gnomon::config
