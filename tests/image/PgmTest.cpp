#include <gnomon/image/Pgm.h>

#include "Pattern.h"
#include "TemporaryFolder.h"

namespace gnomon::image {
namespace {

using PgmTest = TemporaryFolder;

TEST_F(PgmTest, WhatIsWrittenIsRead) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{37, 5}, std::pair{300, 200}}) {
        const auto image = pattern(width, height, 1);
        ASSERT_TRUE(writePgm(path("a.pgm"), image));
        const auto back = readPgm(path("a.pgm"));
        ASSERT_TRUE(back) << back.error().text();
        EXPECT_EQ(*back, image);
    }
    EXPECT_EQ(names(), std::vector<std::string>{"a.pgm"});
}

TEST_F(PgmTest, TheFileIsPlainP5) {
    ASSERT_TRUE(writePgm(path("a.pgm"),
                         Image{.width = 3, .height = 1, .channels = 1, .pixels = {65, 66, 67}}));
    EXPECT_EQ(read(path("a.pgm")), "P5\n3 1\n255\nABC");
}

struct Readable {
    const char* name = "";
    std::string bytes = {};
};

TEST_F(PgmTest, HeadersMayHoldCommentsAndAnyWhiteSpace) {
    const Readable table[] = {
        {"comments", "P5\n# made by hand\n2 # width\n1\n# depth follows\n255\nAB"},
        {"commentAtOnce", "P5# no space\n2 1 255 AB"},
        {"tabs", "P5\t2\t1\r\n255\rAB"},
        {"leadingZeros", "P5 002 01 255\nAB"},
    };
    for (const auto& row : table) {
        const auto image = readPgm(write("a.pgm", row.bytes));
        ASSERT_TRUE(image) << row.name << ": " << image.error().text();
        EXPECT_EQ(image->width, 2) << row.name;
        EXPECT_EQ(image->height, 1) << row.name;
        EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{'A', 'B'})) << row.name;
    }
}

TEST_F(PgmTest, APixelMayLookLikeWhiteSpaceOrAComment) {
    const auto image = readPgm(write("a.pgm", "P5 3 1 255\n\n# "));
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{'\n', '#', ' '}));
}

struct Hostile {
    const char* name = "";
    std::string bytes = {};
    std::string part = {};  // of the error
};

TEST_F(PgmTest, HostileFilesAreRefusedWithAReason) {
    const Hostile table[] = {
        {"empty", "", "does not begin with P5"},
        {"ascii", "P2\n2 1\n255\n1 2\n", "does not begin with P5"},
        {"glued", "P52 1 255\nAB", "does not begin with P5"},
        {"onlyMagic", "P5\n", "header must hold"},
        {"endlessComment", "P5\n# never ends", "header must hold"},
        {"negative", "P5\n-2 1\n255\nAB", "header must hold"},
        {"words", "P5\ntwo one\n255\nAB", "header must hold"},
        {"overflow", "P5\n99999999999999999999 1\n255\nAB", "header must hold"},
        {"wraps", "P5\n4294967298 1\n255\nAB", "header must hold"},
        {"huge", "P5\n65536 65536\n255\nAB", "it is 65536x65536 pixels, each must be 1 to 65535"},
        {"largeButEmpty", "P5\n65535 65535\n255\nAB", "need 4294836225 bytes, 2 follow"},
        {"zero", "P5\n0 1\n255\n", "it is 0x1 pixels"},
        {"sixteenBit", "P5\n2 1\n65535\nABCD", "largest value is 65535, must be 255"},
        {"noPixels", "P5\n2 1\n255", "header must hold"},
        {"short", "P5\n2 1\n255\nA", "2x1 pixels need 2 bytes, 1 follow"},
        {"long", "P5\n2 1\n255\nABC", "2x1 pixels need 2 bytes, 3 follow"},
    };
    for (const auto& row : table) {
        const auto file = write(std::string{row.name} + ".pgm", row.bytes);
        const auto image = readPgm(file);
        ASSERT_FALSE(image) << row.name;
        EXPECT_EQ(image.error().code, Errc::file) << row.name;
        EXPECT_NE(image.error().what.find(file.string()), std::string::npos) << row.name;
        EXPECT_NE(image.error().what.find(row.part), std::string::npos)
            << row.name << ": " << image.error().what;
    }
}

TEST_F(PgmTest, AMissingFileIsNamed) {
    const auto image = readPgm(path("missing.pgm"));
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().text(),
              "cannot read " + path("missing.pgm").string() + ": No such file or directory");
}

TEST_F(PgmTest, AFullDiskIsReported) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    const auto written = writePgm("/dev/full", pattern(4, 4, 1));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().text(), "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace gnomon::image
