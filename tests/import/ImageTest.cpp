#include <gtest/gtest.h>

#include "Model.h"
#include "image/Image.h"

namespace gnomon::importer {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span{text});
}

std::string decodeError(const std::string& file) {
    const auto image = decodedImage(bytesOf(file));
    return image ? "" : image.error().text();
}

TEST(Image, DecodesTopRowFirst) {
    const auto file = png(2, 2, {0x11223344U, 0x55667788U, 0x99aabbccU, 0xddeeff00U});
    const auto image = decodedImage(bytesOf(file));
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->width, 2);
    EXPECT_TRUE(image->hasAlpha);
    const std::vector<std::byte> first{std::byte{0x11}, std::byte{0x22}, std::byte{0x33},
                                       std::byte{0x44}};
    EXPECT_TRUE(std::equal(first.begin(), first.end(), image->pixels.begin()));
    EXPECT_EQ(image->pixels.back(), std::byte{0});
}

TEST(Image, IsRefusedByItsHeaderWhereItIsTooLarge) {
    for (const std::uint32_t side : {16385U, 30000U, 0x7fffffffU, 9000U}) {
        const auto error = decodeError(png(1, 1, {0U}, side));
        EXPECT_NE(error, "") << side;
    }
    EXPECT_NE(decodeError(png(1, 1, {0U}, 9000U)).find("limits"), std::string::npos);
}

TEST(Image, IsRefusedWhereItIsCutOrNone) {
    const auto whole = png(16, 16, std::vector<std::uint32_t>(256, 0xff0000ffU));
    EXPECT_EQ(decodeError(whole), "");
    for (std::size_t size = 0; size + 32 < whole.size(); size += 7)
        EXPECT_NE(decodeError(whole.substr(0, size)), "") << size;
    EXPECT_NE(decodeError("nothing of the kind"), "");
}

TEST(Image, MayBeAJpeg) {
    const auto image = decodedImage(bytesOf(jpeg()));
    ASSERT_TRUE(image) << image.error().text();
    ASSERT_EQ(image->width, 2);
    ASSERT_EQ(image->height, 1);
    EXPECT_FALSE(image->hasAlpha);
    const auto channel = [&](std::size_t i) { return std::to_integer<int>(image->pixels[i]); };
    EXPECT_GT(channel(0), channel(1)) << "red first";
    EXPECT_EQ(channel(3), 255);
    // Damage at the end leaves a picture; damage at the beginning does not.
    EXPECT_EQ(decodeError(jpeg().substr(0, jpeg().size() - 4)), "");
    EXPECT_NE(decodeError(jpeg().substr(0, 100)), "");
}

// Found by a fuzzer: stb_image wrote past the end of its table.
TEST(Image, IsRefusedWhereAJpegsCodesAreMoreThanThereAre) {
    auto file = jpeg();
    const auto table = file.find("\xff\xc4");
    ASSERT_NE(table, std::string::npos);
    for (std::size_t i = 0; i < 16; ++i) file[table + 5 + i] = '\xff';
    EXPECT_NE(decodeError(file), "");
}

TEST(Image, OfSixteenBitsOrGreyBecomesEight) {
    // 1 x 1, 16 bits of grey, stored: 0x80ff.
    std::string file = png(1, 1, {0U});
    file[24] = 16;  // depth
    file[25] = 0;   // grey
    const auto data = file.find("IDAT") + 4;
    file.replace(data + 2 + 5, 5, std::string{"\0\x80\xff\0\0", 5});
    const auto image = decodedImage(bytesOf(file));
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_FALSE(image->hasAlpha);
    EXPECT_EQ(image->pixels,
              (Bytes{std::byte{0x80}, std::byte{0x80}, std::byte{0x80}, std::byte{255}}));
}

TEST(Image, KnowsItsMean) {
    const auto image = decodedImage(bytesOf(png(2, 1, {0xff000033U, 0x00ff0066U})));
    ASSERT_TRUE(image);
    const auto mean = meanOf(*image);
    EXPECT_NEAR(mean.red, 0.5, 1e-9);
    EXPECT_NEAR(mean.green, 0.5, 1e-9);
    EXPECT_NEAR(mean.blue, 0.0, 1e-9);
}

TEST(Image, BecomesNormalsThatLeanAwayFromTheHigherSide) {
    // A ramp that rises to the right, then one that rises upwards.
    Image ramp{.width = 8, .height = 8};
    Image tower{.width = 8, .height = 8};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 4; ++c) {
                ramp.pixels.push_back(static_cast<std::byte>(x * 30));
                tower.pixels.push_back(static_cast<std::byte>((7 - y) * 30));
            }
    EXPECT_TRUE(isGrey(ramp));
    const auto at = [](const Image& image, int channel) {
        return std::to_integer<int>(
            image.pixels[(3 * 8 + 3) * 4 + static_cast<std::size_t>(channel)]);
    };
    const auto right = normalsFromHeights(ramp, 1.0F);
    EXPECT_LT(at(right, 0), 127);
    EXPECT_NEAR(at(right, 1), 128, 1);
    const auto up = normalsFromHeights(tower, 1.0F);
    EXPECT_NEAR(at(up, 0), 128, 1);
    EXPECT_LT(at(up, 1), 127);
}

TEST(Image, TakesAnotherOnesAlphaOrBrightness) {
    Image image{.width = 2, .height = 2, .pixels = Bytes(16, std::byte{9})};
    Image grey{.width = 1, .height = 2, .pixels = Bytes(8, std::byte{77})};
    putAlpha(image, grey);
    EXPECT_EQ(image.pixels[3], std::byte{77});
    EXPECT_EQ(image.pixels[0], std::byte{9});
    grey.hasAlpha = true;
    grey.pixels[7] = std::byte{5};
    putAlpha(image, grey);
    EXPECT_EQ(image.pixels[15], std::byte{5});
    EXPECT_EQ(image.pixels[3], std::byte{77});
}

}  // namespace
}  // namespace gnomon::importer
