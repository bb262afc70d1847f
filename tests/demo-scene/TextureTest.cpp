#include <gnomon/demo/Textures.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace gnomon::demo {
namespace {

/// Mean difference of the colours of two columns (or rows) of an image.
double difference(const Image& image, bool columns, std::uint32_t first, std::uint32_t second) {
    const std::uint32_t length = columns ? image.height : image.width;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < length; ++i) {
        const std::uint8_t* a = columns ? image.at(first, i) : image.at(i, first);
        const std::uint8_t* b = columns ? image.at(second, i) : image.at(i, second);
        for (int c = 0; c < 3; ++c) sum += std::abs(int{a[c]} - int{b[c]});
    }
    return sum / (3.0 * length);
}

/// How visible the joint of two copies is: the step across it over the largest step inside.
double seam(const Image& image, bool columns) {
    const std::uint32_t count = columns ? image.width : image.height;
    double inside = 0.0;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        inside = std::max(inside, difference(image, columns, i, i + 1));
    }
    return difference(image, columns, count - 1, 0) / inside;
}

/// Most of what holds for a texture holds at any size; small ones are quick.
Texture small(const TextureInfo& info, std::uint64_t seed) {
    return info.make(seed, info.size / 4);
}

class EveryTexture : public testing::TestWithParam<TextureInfo> {};

/// The upper left two thirds of each side: what was a texture that tiles no longer is one.
Image cutShort(const Image& whole) {
    Image cut{"cut", whole.width * 2 / 3, whole.height * 2 / 3};
    for (std::uint32_t y = 0; y < cut.height; ++y) {
        for (std::uint32_t x = 0; x < cut.width; ++x) std::memcpy(cut.at(x, y), whole.at(x, y), 4);
    }
    return cut;
}

TEST_P(EveryTexture, JoinsItselfWithoutASeam) {
    if (GetParam().metres == 0.0F) GTEST_SKIP() << "a picture that is not repeated";
    // At full size: with fewer texels the steps inside grow until they would hide a seam.
    const Texture texture = GetParam().make(4, GetParam().size);
    for (const bool columns : {true, false}) {
        EXPECT_LE(seam(texture.colour, columns), 1.05)
            << (columns ? "left and right" : "top and bottom");
        if (texture.normal) {
            EXPECT_LE(seam(*texture.normal, columns), 1.05);
        }
    }
    // The measure would have seen one.
    const Image cut = cutShort(texture.colour);
    EXPECT_GT(std::max(seam(cut, true), seam(cut, false)), 1.5);
}

TEST_P(EveryTexture, IsDrawnAndDependsOnTheSeed) {
    const Texture texture = small(GetParam(), 4);
    const auto [low, high] =
        std::minmax_element(texture.colour.pixels.begin(), texture.colour.pixels.end());
    EXPECT_GT(*high - *low, 40);
    EXPECT_EQ(texture.colour.pixels, small(GetParam(), 4).colour.pixels);
    EXPECT_NE(texture.colour.pixels, small(GetParam(), 5).colour.pixels);
}

TEST_P(EveryTexture, HasNormalsThatPointOutOfTheSurface) {
    const Texture texture = small(GetParam(), 4);
    if (!texture.normal) GTEST_SKIP() << "no normal map";
    double x = 0.0;
    double y = 0.0;
    for (std::size_t i = 0; i < texture.normal->pixels.size(); i += 4) {
        ASSERT_GT(texture.normal->pixels[i + 2], 127);
        x += texture.normal->pixels[i];
        y += texture.normal->pixels[i + 1];
    }
    // A surface that closes on itself has no slope on average.
    const double count = static_cast<double>(texture.normal->pixels.size()) / 4.0;
    EXPECT_NEAR(x / count, 127.5, 6.0);
    EXPECT_NEAR(y / count, 127.5, 6.0);
}

INSTANTIATE_TEST_SUITE_P(All, EveryTexture, testing::ValuesIn(textures().begin(), textures().end()),
                         [](const auto& row) { return std::string{row.param.name}; });

/// Reads with libpng's simplified interface: another code path than the one that wrote.
TEST(Png, BringsEveryPixelBack) {
    for (const Image& image : {banner(1, 128).colour, leaves(1, 128).colour}) {
        const std::vector<std::uint8_t> bytes = encodePng(image);
        png_image header{};
        header.version = PNG_IMAGE_VERSION;
        ASSERT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0);
        EXPECT_EQ(header.width, image.width);
        EXPECT_EQ(header.height, image.height);
        header.format = PNG_FORMAT_RGBA;
        std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(header));
        ASSERT_NE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr), 0);
        EXPECT_EQ(pixels, image.pixels);
    }
}

}  // namespace
}  // namespace gnomon::demo
