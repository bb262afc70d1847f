// Measures of error on pictures whose error is known.
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::truth {
namespace {

/// 64 x 64: lit on the left of an edge, shadowed from column @p edge on.
image::Image half(int edge) {
    image::Image picture = image::blank(64, 64, 1);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            picture.pixels[static_cast<std::size_t>(y * 64 + x)] = x < edge ? 255 : 0;
    return picture;
}

TEST(ShadowError, OfTheTruthItselfIsNone) {
    const auto error = compareFactors(half(30), half(30));
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->counted, 4096U);
    EXPECT_EQ(error->wrong, 0U);
    EXPECT_EQ(error->rmse, 0.0);
    EXPECT_EQ(error->edgeMean, 0.0);
    EXPECT_NEAR(error->ssim, 1.0, 1e-6);
    EXPECT_NEAR(error->flip, 0.0, 1e-6);
}

TEST(ShadowError, CountsWrongPixelsBySideAndPlace) {
    // The edge moved to the right by one: a column lit falsely, next to the edge.
    auto error = compareFactors(half(30), half(31));
    EXPECT_EQ(error->wrong, 64U);
    EXPECT_EQ(error->falseLight, 64U);
    EXPECT_EQ(error->falseShadow, 0U);
    EXPECT_EQ(error->nearEdge, 64U);
    EXPECT_EQ(error->interior, 0U);
    EXPECT_NEAR(error->rmse, std::sqrt(1.0 / 64.0), 1e-9);
    EXPECT_NEAR(error->edgeMean, 0.5, 1e-6) << "of the two columns of an edge one has not moved";
    // By ten: most of it is far from the edge.
    error = compareFactors(half(30), half(20));
    EXPECT_EQ(error->falseShadow, 640U);
    EXPECT_EQ(error->interior, 64U * 7U);
    EXPECT_NEAR(error->edgeMean, 9.5, 1e-4);
}

TEST(ShadowError, WhatTheTruthDoesNotCountDoesNotCount) {
    image::Image truth = half(30);
    image::Image factor = half(0);  // all dark
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        if (i % 64 < 30) truth.pixels[i] = noSurface;
    const auto error = compareFactors(truth, factor);
    EXPECT_EQ(error->counted, 34U * 64U);
    EXPECT_EQ(error->wrong, 0U);
    factor.pixels[40] = noSurface;
    EXPECT_EQ(compareFactors(truth, factor)->holes, 1U);
}

TEST(ShadowError, SidesAreTakenAtHalf) {
    image::Image truth = half(64);
    image::Image factor = half(64);
    truth.pixels[0] = 127;
    factor.pixels[0] = 129;
    EXPECT_EQ(compareFactors(truth, factor)->wrong, 1U);
    factor.pixels[0] = 126;
    EXPECT_EQ(compareFactors(truth, factor)->wrong, 0U);
}

TEST(ShadowError, OtherSizesAreAnError) {
    const auto error = compareFactors(half(30), image::blank(64, 63, 1));
    ASSERT_FALSE(error.has_value());
    EXPECT_NE(error.error().what.find("64x64"), std::string::npos);
    EXPECT_NE(error.error().what.find("64x63"), std::string::npos);
}

TEST(ShadowError, ThePictureShowsWhichSideIsWrong) {
    const auto picture = errorPicture(half(30), half(31));
    const auto at = [&](int x, int channel) {
        return picture.pixels[static_cast<std::size_t>(x * 3 + channel)];
    };
    EXPECT_GT(at(30, 2), 200);
    EXPECT_EQ(at(30, 0), 0);
    EXPECT_EQ(at(10, 0), at(10, 2)) << "grey where it is right";
}

}  // namespace
}  // namespace gnomon::truth
