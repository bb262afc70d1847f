#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "KeySampler.h"

namespace gnomon::client {
namespace {

using Interpolation = scene::AnimationChannel::Interpolation;
using math::dvec3;
using math::dvec4;

constexpr std::array<float, 3> times{1.0F, 2.0F, 4.0F};

void expectNear(const dvec3& a, const dvec3& b, double tolerance = 1e-6) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

TEST(KeySampler, HoldsTheEndsBeforeAndAfter) {
    const std::array<float, 9> values{1, 0, 0, 2, 0, 0, 8, 0, 0};
    for (const auto kind : {Interpolation::linear, Interpolation::step}) {
        const Keys keys{.interpolation = kind, .times = times, .values = values};
        expectNear(sampleVector(keys, -5.0), {1, 0, 0});
        expectNear(sampleVector(keys, 1.0), {1, 0, 0});
        expectNear(sampleVector(keys, 4.0), {8, 0, 0});
        expectNear(sampleVector(keys, 99.0), {8, 0, 0});
    }
}

TEST(KeySampler, LinearIsOnTheChord) {
    const std::array<float, 9> values{1, 0, -1, 2, 10, -2, 8, 0, -4};
    const Keys keys{.times = times, .values = values};
    expectNear(sampleVector(keys, 1.25), {1.25, 2.5, -1.25});
    expectNear(sampleVector(keys, 3.5), {6.5, 2.5, -3.5});
}

TEST(KeySampler, StepKeepsTheKeyBefore) {
    const std::array<float, 9> values{1, 0, 0, 2, 0, 0, 8, 0, 0};
    const Keys keys{.interpolation = Interpolation::step, .times = times, .values = values};
    expectNear(sampleVector(keys, 1.999), {1, 0, 0});
    expectNear(sampleVector(keys, 2.0), {2, 0, 0});
    expectNear(sampleVector(keys, 3.999), {2, 0, 0});
}

// A cubic is its own spline, if the tangents are its derivatives: x(t) = t^3 - 2 t^2 + 3.
TEST(KeySampler, CubicSplineReproducesACubic) {
    const auto x = [](double t) { return t * t * t - 2 * t * t + 3; };
    const auto slope = [](double t) { return 3 * t * t - 4 * t; };
    std::vector<float> values;
    for (const float t : times)
        for (const double v : {slope(t), x(t), slope(t)})
            for (const double axis : {v, 0.0, -v}) values.push_back(static_cast<float>(axis));
    const Keys keys{.interpolation = Interpolation::cubicSpline, .times = times, .values = values};
    ASSERT_TRUE(complete(keys, 3));
    for (double t = 1.0; t <= 4.0; t += 0.125)
        expectNear(sampleVector(keys, t), {x(t), 0, -x(t)}, 1e-4);
}

dvec4 aboutY(double angle) { return {0.0, std::sin(angle / 2), 0.0, std::cos(angle / 2)}; }

TEST(KeySampler, RotationsTurnEvenly) {
    std::vector<float> values;
    for (const double angle : {0.0, 1.0, 3.0})
        for (int i = 0; i < 4; ++i) values.push_back(static_cast<float>(aboutY(angle)[i]));
    const Keys keys{.times = times, .values = values};
    for (const auto& [time, angle] : {std::pair{1.5, 0.5}, {2.5, 1.5}, {3.9, 2.9}}) {
        const dvec4 q = sampleRotation(keys, time);
        EXPECT_NEAR(glm::dot(q, aboutY(angle)), 1.0, 1e-9) << time;
        EXPECT_NEAR(glm::length(q), 1.0, 1e-12);
    }
}

TEST(KeySampler, RotationsTakeTheShorterWay) {
    const dvec4 half = -aboutY(0.5);  // the same rotation as aboutY(0.5)
    const std::array<float, 2> two{0.0F, 1.0F};
    const std::array<float, 8> values{0,
                                      0,
                                      0,
                                      1,
                                      static_cast<float>(half.x),
                                      static_cast<float>(half.y),
                                      static_cast<float>(half.z),
                                      static_cast<float>(half.w)};
    const Keys keys{.times = two, .values = values};
    EXPECT_NEAR(std::abs(glm::dot(sampleRotation(keys, 0.5), aboutY(0.25))), 1.0, 1e-9);
}

TEST(KeySampler, AZeroQuaternionIsNoRotation) {
    const std::array<float, 1> one{0.0F};
    const std::array<float, 4> values{};
    EXPECT_EQ(sampleRotation({.times = one, .values = values}, 0.0), (dvec4{0, 0, 0, 1}));
}

TEST(KeySampler, MissingValuesAreNoticed) {
    const std::array<float, 8> values{};
    EXPECT_FALSE(complete({.times = times, .values = values}, 3));
    EXPECT_FALSE(complete({.times = {}, .values = values}, 3));
    EXPECT_TRUE(complete({.times = std::span{times}.first(2), .values = values}, 3));
    EXPECT_FALSE(complete({.interpolation = Interpolation::cubicSpline,
                           .times = std::span{times}.first(2),
                           .values = values},
                          3));
}

}  // namespace
}  // namespace gnomon::client
