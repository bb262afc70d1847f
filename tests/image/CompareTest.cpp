#include <gnomon/image/Compare.h>
#include <gtest/gtest.h>

#include "Pattern.h"

namespace gnomon::image {
namespace {

TEST(Compare, EqualImagesDoNotDiffer) {
    const auto image = pattern(16, 9, 3);
    const auto difference = compare(image, image, 0);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->share, 0.0);
    EXPECT_EQ(difference->largest, 0);
    EXPECT_EQ(difference->mean, 0.0);
}

TEST(Compare, CountsPixelsByTheirLargestChannel) {
    const auto a = blank(4, 2, 3);  // 8 pixels, 24 values
    auto b = a;
    b.pixels[0] = 2;  // not over the threshold
    b.pixels[3] = 3;  // over, in two channels of one pixel
    b.pixels[4] = 10;
    b.pixels[23] = 255;  // over
    const auto difference = compare(a, b, 2);
    ASSERT_TRUE(difference);
    EXPECT_DOUBLE_EQ(difference->share, 2.0 / 8.0);
    EXPECT_EQ(difference->largest, 255);
    EXPECT_DOUBLE_EQ(difference->mean, 270.0 / 24.0);
}

TEST(Compare, IsSymmetric) {
    const auto a = pattern(31, 17, 4);
    auto b = a;
    for (std::size_t i = 0; i < b.pixels.size(); i += 3)
        b.pixels[i] = static_cast<std::uint8_t>(255 - b.pixels[i]);
    const auto ab = compare(a, b, 20).value();
    const auto ba = compare(b, a, 20).value();
    EXPECT_EQ(ab.share, ba.share);
    EXPECT_EQ(ab.largest, ba.largest);
    EXPECT_EQ(ab.mean, ba.mean);
    EXPECT_GT(ab.share, 0.0);
}

TEST(Compare, DifferentShapesAreAnErrorThatNamesBoth) {
    const auto difference = compare(blank(4, 3, 3), blank(4, 2, 1), 0);
    ASSERT_FALSE(difference);
    EXPECT_EQ(difference.error().what,
              "images to compare must be alike: one is 4x3 with 3 channels, the other 4x2 with 1");
}

TEST(DifferenceImage, ShowsAbsoluteDifferencesTimesTheGain) {
    const Image a{.width = 2, .height = 1, .channels = 1, .pixels = {10, 200}};
    const Image b{.width = 2, .height = 1, .channels = 1, .pixels = {13, 100}};
    EXPECT_EQ(differenceImage(a, b).pixels, (std::vector<std::uint8_t>{3, 100}));
    EXPECT_EQ(differenceImage(a, b, 4).pixels, (std::vector<std::uint8_t>{12, 255}));
}

TEST(DifferenceImage, ShowsAlphaAsColour) {
    const Image a{.width = 1, .height = 1, .channels = 4, .pixels = {1, 2, 3, 100}};
    const Image b{.width = 1, .height = 1, .channels = 4, .pixels = {1, 2, 5, 90}};
    const auto difference = differenceImage(a, b);
    EXPECT_EQ(difference.channels, 3);
    EXPECT_EQ(difference.pixels, (std::vector<std::uint8_t>{10, 10, 12}));
}

TEST(Image, SoundnessCoversSizeChannelsAndBytes) {
    EXPECT_TRUE(isSound(blank(3, 2, 4)));
    EXPECT_FALSE(isSound(Image{}));
    EXPECT_FALSE(isSound({.width = 2, .height = 1, .channels = 2, .pixels = {1, 2, 3, 4}}));
    EXPECT_FALSE(isSound({.width = 2, .height = 1, .channels = 1, .pixels = {1}}));
    EXPECT_FALSE(isSound({.width = -1, .height = -1, .channels = 1, .pixels = {1}}));
    EXPECT_FALSE(isSound({.width = 65536, .height = 1, .channels = 1, .pixels = {}}));
}

}  // namespace
}  // namespace gnomon::image
