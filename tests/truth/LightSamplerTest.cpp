// Where rays to a light go, against what geometry says.
#include <gnomon/truth/LightSampler.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace gnomon::truth {
namespace {

using math::dvec2;
using math::dvec3;
using shadow_fit::LightKind;
using shadow_fit::LightShape;

constexpr std::uint32_t many = 4096;

TEST(LightSampler, ASunsRaysFillItsDiskBySolidAngle) {
    const LightShape sun{.direction = glm::normalize(dvec3{1.0, -2.0, 0.5}), .extent = 0.1};
    const LightSampler sampler{sun, dvec3{0.0}};
    std::array<int, 4> rings{};
    dvec3 mean{0.0};
    for (std::uint32_t i = 0; i < many; ++i) {
        const auto ray = sampler.sample({5.0, 6.0, 7.0}, stratified(i, 1));
        EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
        EXPECT_TRUE(std::isinf(ray.reach));
        const double cosine = glm::dot(ray.direction, -sun.direction);
        ASSERT_GE(cosine, std::cos(0.1) - 1e-12);
        // Rings of equal solid angle hold equally many.
        const double share = (1.0 - cosine) / (1.0 - std::cos(0.1));
        ++rings.at(std::min<std::size_t>(static_cast<std::size_t>(share * 4.0), 3));
        mean += ray.direction / static_cast<double>(many);
    }
    for (const int count : rings) EXPECT_NEAR(count, many / 4.0, 40.0);
    EXPECT_LT(glm::length(glm::normalize(mean) + sun.direction), 1e-3) << "around its centre";
}

TEST(LightSampler, ASpotsRaysEndOnItsDisk) {
    const LightShape spot{.kind = LightKind::spot,
                          .position = {1.0, 5.0, 2.0},
                          .direction = glm::normalize(dvec3{0.2, -1.0, 0.0}),
                          .extent = 0.5};
    const dvec3 origin{100.0, 0.0, 0.0};
    const LightSampler sampler{spot, origin};
    const dvec3 from{-99.0, 0.0, 1.0};  // relative to the origin
    for (std::uint32_t i = 0; i < many; ++i) {
        const auto ray = sampler.sample(from, stratified(i, 2));
        const dvec3 end = from + ray.direction * ray.reach + origin;
        EXPECT_NEAR(glm::dot(end - spot.position, spot.direction), 0.0, 1e-9);
        EXPECT_LE(glm::length(end - spot.position), 0.5 + 1e-9);
    }
}

TEST(LightSampler, ASpheresRaysEndOnItsNearSide) {
    const LightShape bulb{.kind = LightKind::point, .position = {0.0, 3.0, 0.0}, .extent = 0.4};
    const LightSampler sampler{bulb, dvec3{0.0}};
    const dvec3 from{1.0, 0.0, 0.5};
    for (std::uint32_t i = 0; i < many; ++i) {
        const auto ray = sampler.sample(from, stratified(i, 3));
        const dvec3 end = from + ray.direction * ray.reach;
        EXPECT_NEAR(glm::length(end - bulb.position), 0.4, 1e-6);
        EXPECT_LE(glm::dot(end - bulb.position, ray.direction), 1e-6) << "not through it";
    }
    const auto inside = sampler.sample(bulb.position + dvec3{0.1, 0.0, 0.0}, {0.3, 0.3});
    EXPECT_TRUE(std::isfinite(inside.reach));
}

TEST(LightSampler, OutsideItsConeASpotDoesNotShine) {
    const LightShape spot{.kind = LightKind::spot,
                          .position = {0.0, 4.0, 0.0},
                          .direction = {0.0, -1.0, 0.0},
                          .halfAngle = 0.5,
                          .range = 10.0};
    const LightSampler sampler{spot, dvec3{0.0}};
    const double edge = 4.0 * std::tan(0.5);
    EXPECT_TRUE(sampler.shinesAt({edge * 0.999, 0.0, 0.0}));
    EXPECT_FALSE(sampler.shinesAt({edge * 1.001, 0.0, 0.0}));
    EXPECT_FALSE(sampler.shinesAt({0.0, 5.0, 0.0})) << "behind it";
    EXPECT_FALSE(sampler.shinesAt({0.0, -6.5, 0.0})) << "beyond its range";
}

TEST(LightSampler, TheRimOfTheDiskIsTheRimOfTheSun) {
    const LightShape sun{.direction = glm::normalize(dvec3{1.0, -2.0, 0.5}), .extent = 0.1};
    const LightSampler sampler{sun, dvec3{0.0}};
    for (const dvec2& rim : {dvec2{1.0, 0.0}, dvec2{0.0, -1.0}, dvec2{0.6, 0.8}})
        EXPECT_NEAR(glm::dot(sampler.toward(dvec3{0.0}, rim).direction, -sun.direction),
                    std::cos(0.1), 1e-12);
    EXPECT_LT(glm::length(sampler.toward(dvec3{0.0}, dvec2{0.0}).direction + sun.direction), 1e-12);
}

TEST(Sunflower, HasOnEachSideOfAnyLineItsShareOfTheDisk) {
    constexpr std::uint32_t count = 64;
    for (int turn = 0; turn < 180; ++turn) {
        const double angle = turn * std::numbers::pi / 180.0;
        for (double t = -0.98; t < 1.0; t += 0.02) {
            int below = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                below += glm::dot(sunflower(i, count), dvec2{std::cos(angle), std::sin(angle)}) < t
                             ? 1
                             : 0;
            const double share =
                0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / std::numbers::pi;
            EXPECT_NEAR(below / static_cast<double>(count), share, 0.05) << turn << " " << t;
        }
    }
}

TEST(Stratified, FirstPowersOfTwoFillEveryElementaryInterval) {
    for (const std::uint32_t pixel : {0U, 7U, 123456U}) {
        for (const auto& [columns, rows] :
             {std::pair{16, 16}, std::pair{256, 1}, std::pair{4, 64}}) {
            std::vector<int> cells(256, 0);
            for (std::uint32_t i = 0; i < 256; ++i) {
                const dvec2 u = stratified(i, pixel);
                ASSERT_TRUE(u.x >= 0.0 && u.x < 1.0 && u.y >= 0.0 && u.y < 1.0);
                ++cells[static_cast<std::size_t>(static_cast<int>(u.y * rows) * columns +
                                                 static_cast<int>(u.x * columns))];
            }
            for (const int count : cells) EXPECT_EQ(count, 1) << columns << " x " << rows;
        }
    }
}

}  // namespace
}  // namespace gnomon::truth
