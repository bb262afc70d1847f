#include <gnomon/image/Png.h>
#include <png.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "Pattern.h"
#include "TemporaryFolder.h"

namespace gnomon::image {
namespace {

class PngTest : public TemporaryFolder {
protected:
    /// Writes with libpng what writePng() never does: other layouts of pixels.
    std::filesystem::path writeWithLibpng(const std::string& name, png_uint_32 format, int width,
                                          int height, const void* pixels, const void* colormap,
                                          png_uint_32 entries) const {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = static_cast<png_uint_32>(width);
        image.height = static_cast<png_uint_32>(height);
        image.format = format;
        image.colormap_entries = entries;
        EXPECT_NE(png_image_write_to_file(&image, path(name).c_str(), 0, pixels, 0, colormap), 0)
            << image.message;
        return path(name);
    }
    void expectUnreadable(const std::filesystem::path& file, const std::string& part) const {
        const auto image = readPng(file);
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().code, Errc::file);
        EXPECT_NE(image.error().text().find(file.string()), std::string::npos)
            << image.error().text();
        EXPECT_NE(image.error().text().find(part), std::string::npos) << image.error().text();
    }
};

TEST_F(PngTest, WhatIsWrittenIsRead) {
    for (const int channels : {1, 3, 4}) {
        for (const auto& [width, height] :
             {std::pair{1, 1}, std::pair{37, 5}, std::pair{256, 64}}) {
            const auto image = pattern(width, height, channels);
            ASSERT_TRUE(writePng(path("a.png"), image));
            const auto back = readPng(path("a.png"));
            ASSERT_TRUE(back) << back.error().text();
            EXPECT_EQ(*back, image) << width << "x" << height << "x" << channels;
        }
    }
    EXPECT_EQ(names(), std::vector<std::string>{"a.png"});
}

TEST_F(PngTest, AFileOnDiskHasTheTopRowFirst) {
    // The first pixel of the first row, through libpng itself.
    auto image = blank(2, 2, 3);
    image.pixels[0] = 200;
    ASSERT_TRUE(writePng(path("a.png"), image));
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&png, path("a.png").c_str()), 0);
    png.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
    ASSERT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(pixels, image.pixels);
}

TEST_F(PngTest, PalettesAndGreyWithAlphaAreConverted) {
    const std::vector<std::uint8_t> indices{0, 1, 1, 0};
    const std::vector<std::uint8_t> colours{10, 20, 30, 40, 50, 60};
    const auto palette = readPng(
        writeWithLibpng("p.png", PNG_FORMAT_RGB_COLORMAP, 2, 2, indices.data(), colours.data(), 2));
    ASSERT_TRUE(palette) << palette.error().text();
    EXPECT_EQ(palette->channels, 3);
    EXPECT_EQ(palette->pixels,
              (std::vector<std::uint8_t>{10, 20, 30, 40, 50, 60, 40, 50, 60, 10, 20, 30}));

    const std::vector<std::uint8_t> grey{100, 255, 7, 128};
    const auto alpha =
        readPng(writeWithLibpng("ga.png", PNG_FORMAT_GA, 2, 1, grey.data(), nullptr, 0));
    ASSERT_TRUE(alpha) << alpha.error().text();
    EXPECT_EQ(alpha->channels, 4);
    EXPECT_EQ(alpha->pixels, (std::vector<std::uint8_t>{100, 100, 100, 255, 7, 7, 7, 128}));
}

TEST_F(PngTest, EveryTruncationIsAnError) {
    ASSERT_TRUE(writePng(path("a.png"), pattern(9, 7, 3)));
    const auto whole = read(path("a.png"));
    // The last chunk, IEND, is 12 bytes without content; libpng may do without it.
    for (std::size_t length = 0; length + 12 < whole.size(); ++length)
        ASSERT_FALSE(readPng(write("cut.png", whole.substr(0, length)))) << length << " bytes";
}

TEST_F(PngTest, BadFilesAreRefusedByName) {
    expectUnreadable(path("missing.png"), "No such file or directory");
    expectUnreadable(write("text.png", "this is no picture at all"), "as PNG");
    expectUnreadable(path(""), "directory");
}

TEST_F(PngTest, AHugeHeaderIsRefusedBeforeItsPixelsAreAllocated) {
    ASSERT_TRUE(writePng(path("a.png"), pattern(4, 4, 4)));
    auto bytes = read(path("a.png"));
    // IHDR: 8 bytes signature, 8 chunk head, width, height, 5 more, then the CRC over type and
    // data.
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i)
            bytes.at(at + i) = static_cast<char>(value >> (24U - 8U * i) & 0xffU);
    };
    put(16, 40000);
    put(20, 40000);
    std::uint32_t crc = 0xffffffffU;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= static_cast<std::uint8_t>(bytes[i]);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    }
    put(29, ~crc);
    expectUnreadable(write("huge.png", bytes), "40000x40000 pixels of 4 bytes");
}

TEST_F(PngTest, WritingWhereThereIsNoFolderNamesPathAndReason) {
    const auto target = path("none") / "a.png";
    const auto written = writePng(target, pattern(4, 4, 3));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, Errc::file);
    EXPECT_EQ(written.error().text(),
              "cannot write " + target.string() + ": No such file or directory");
}

TEST_F(PngTest, AFailedWriteLeavesTheOldFileAndNothingElse) {
    const auto old = pattern(4, 4, 3);
    ASSERT_TRUE(writePng(path("a.png"), old));
    // The next file may have 4096 bytes: the disk is full, as far as this process can tell.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto written = writePng(path("a.png"), pattern(256, 256, 4));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);

    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().text(),
              "cannot write " + path("a.png").string() + ": File too large");
    EXPECT_EQ(readPng(path("a.png")).value(), old);
    EXPECT_EQ(names(), std::vector<std::string>{"a.png"});
}

TEST_F(PngTest, WritingKeepsLinksAndTheUsersFileMode) {
    ASSERT_TRUE(writePng(path("real.png"), pattern(2, 2, 1)));
    std::filesystem::create_symlink(path("real.png"), path("link.png"));
    const auto image = pattern(5, 5, 1);
    ASSERT_TRUE(writePng(path("link.png"), image));
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.png")));
    EXPECT_EQ(readPng(path("real.png")).value(), image);

    const auto mask = ::umask(0);
    ::umask(mask);
    struct stat status {};
    ASSERT_EQ(::stat(path("real.png").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0666U & ~mask);
}

TEST_F(PngTest, ADeviceIsWrittenToNotReplaced) {
    ASSERT_TRUE(writePng("/dev/null", pattern(8, 8, 3)));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace gnomon::image
