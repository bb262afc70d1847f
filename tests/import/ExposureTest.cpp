#include <gtest/gtest.h>

#include <limits>

#include "build/Exposure.h"
#include "build/Phong.h"
#include "build/SceneBuilder.h"

namespace gnomon::importer {
namespace {

using Kind = LightDraft::Kind;

const math::Box unitBox{.min = math::dvec3{-10.0}, .max = math::dvec3{10.0}};

TEST(Exposure, MakesTheBrightestSunOneWhateverItsUnit) {
    for (const double lux : {0.8, 3.0, 1.0e5}) {
        const LightDraft lights[] = {{.kind = Kind::directional, .intensity = lux},
                                     {.kind = Kind::directional, .intensity = lux / 4.0},
                                     {.kind = Kind::point, .intensity = 1.0e9}};
        EXPECT_NEAR(exposure(lights, {}, unitBox) * lux, 1.0, 1e-12);
    }
}

TEST(Exposure, MakesTheStrongestLampOneNearWhatItStandsBy) {
    // A seventh of the radius where something is closer, else the distance to it.
    const math::Box floor{.min = {-10.0, -10.0, -10.0}, .max = {10.0, -10.0, 10.0}};
    const LightDraft inside[] = {{.kind = Kind::point, .intensity = 500.0},
                                 {.kind = Kind::spot, .intensity = 5.0}};
    const double near = unitBox.radius() / 7.0;
    EXPECT_NEAR(exposure(inside, {{unitBox}}, unitBox) * 500.0 / (near * near), 1.0, 1e-12);
    EXPECT_NEAR(exposure(inside, {{floor}}, unitBox) * 500.0 / 100.0, 1.0, 1e-12);
}

TEST(Exposure, GoesByTheRangeOfALampThatReachesLessFar) {
    const LightDraft light[] = {{.intensity = 8.0, .range = 1.0}};
    EXPECT_NEAR(exposure(light, {{unitBox}}, unitBox) * 8.0 / 0.25, 1.0, 1e-12);
}

TEST(Exposure, IsOneWithoutLightAndFiniteForSillyNumbers) {
    EXPECT_EQ(exposure({}, {}, unitBox), 1.0);
    const LightDraft dark[] = {{.intensity = 0.0}};
    EXPECT_EQ(exposure(dark, {}, unitBox), 1.0);
    const LightDraft faint[] = {
        {.kind = Kind::directional, .intensity = std::numeric_limits<double>::denorm_min()}};
    EXPECT_TRUE(std::isfinite(exposure(faint, {}, unitBox)));
    const math::Box point{.min = math::dvec3{0.0}, .max = math::dvec3{0.0}};
    const LightDraft lamp[] = {{.intensity = 5.0}};
    EXPECT_EQ(exposure(lamp, {{point}}, point), 1.0);
}

TEST(Exposure, EndsALampWhereItCanNoLongerBeSeen) {
    EXPECT_NEAR(2.0 / (derivedRange(2.0) * derivedRange(2.0)), 0.01, 1e-12);
    EXPECT_EQ(derivedRange(0.0), 0.0);
}

TEST(Phong, ShininessFallsWithRoughnessWithinItsBounds) {
    EXPECT_EQ(shininessOf(0.0), 2048.0F);
    EXPECT_EQ(shininessOf(1.0), 2.0F);
    EXPECT_NEAR(shininessOf(0.5), 30.0F, 1e-4F);
    EXPECT_EQ(shininessOf(std::numeric_limits<double>::quiet_NaN()), 2048.0F);
}

TEST(Phong, SrgbIsUndone) {
    EXPECT_EQ(linearFromSrgb(0.0), 0.0);
    EXPECT_EQ(linearFromSrgb(1.0), 1.0);
    EXPECT_NEAR(linearFromSrgb(0.5), 0.21404, 1e-5);
    EXPECT_EQ(byteOf(-1.0), 0);
    EXPECT_EQ(byteOf(2.0), 255);
}

}  // namespace
}  // namespace gnomon::importer
