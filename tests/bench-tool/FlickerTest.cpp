// Sequences of a few pixels whose flicker is known.
#include <gtest/gtest.h>

#include "bench/Flicker.h"

namespace gnomon::client {
namespace {

image::Image pixels(std::vector<std::uint8_t> values) {
    return {.width = static_cast<int>(values.size()),
            .height = 1,
            .channels = 1,
            .pixels = std::move(values)};
}

TEST(Flicker, OnePixelOfFourThatBlinksIsAQuarterOfEveryPair) {
    const auto truth = pixels({255, 255, 0, 0});
    Flicker flicker;
    for (int i = 0; i < 5; ++i)
        flicker.add(truth, pixels({255, i % 2 == 0 ? std::uint8_t{255} : std::uint8_t{0}, 0, 0}));
    EXPECT_EQ(flicker.found().counted, 16U);
    EXPECT_EQ(flicker.found().flipped, 4U);
    EXPECT_DOUBLE_EQ(flicker.found().share(), 0.25);
    EXPECT_DOUBLE_EQ(flicker.found().meanChange, 0.25);
}

TEST(Flicker, WhatIsWrongButHoldsStillDoesNotFlicker) {
    Flicker flicker;
    for (int i = 0; i < 3; ++i) flicker.add(pixels({255, 0}), pixels({0, 255}));
    EXPECT_EQ(flicker.found().counted, 4U);
    EXPECT_EQ(flicker.found().share(), 0.0);
}

TEST(Flicker, ShadowsThatMoveAsTheTruthDoesDoNotFlicker) {
    Flicker flicker;
    flicker.add(pixels({255, 255, 0, 0}), pixels({255, 255, 0, 0}));
    flicker.add(pixels({255, 0, 0, 255}), pixels({255, 0, 0, 255}));
    EXPECT_EQ(flicker.found().counted, 2U) << "pixels 0 and 2 stayed";
    EXPECT_EQ(flicker.found().flipped, 0U);
    EXPECT_EQ(flicker.found().meanChange, 0.0);
}

TEST(Flicker, PixelsWithoutASurfaceInEitherFrameAreNotCounted) {
    Flicker flicker;
    flicker.add(pixels({128, 255, 128}), pixels({0, 0, 0}));
    flicker.add(pixels({128, 128, 255}), pixels({255, 255, 255}));
    EXPECT_EQ(flicker.found().counted, 0U);
    EXPECT_EQ(flicker.found().share(), 0.0);
}

TEST(Flicker, SoftEdgesCountByHowMuchTheyChange) {
    Flicker flicker;
    // The sampled truth trembles by less than can be told.
    flicker.add(pixels({100, 100}), pixels({100, 120}));
    flicker.add(pixels({102, 98}), pixels({151, 120}));
    EXPECT_EQ(flicker.found().counted, 2U);
    EXPECT_EQ(flicker.found().flipped, 1U);
    EXPECT_NEAR(flicker.found().meanChange, 51.0 / 255.0 / 2.0, 1e-12);
    // And a truth that changes sides, however little, has changed.
    Flicker sides;
    sides.add(pixels({126}), pixels({126}));
    sides.add(pixels({129}), pixels({129}));
    EXPECT_EQ(sides.found().counted, 0U);
}

}  // namespace
}  // namespace gnomon::client
