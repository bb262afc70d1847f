#include "Flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::truth {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

float linear(float s) { return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F); }

/// CIE lightness, 0 to 100, from relative luminance.
float lightness(float y) {
    constexpr float delta = 6.0F / 29.0F;
    const float f =
        y > delta * delta * delta ? std::cbrt(y) : y / (3.0F * delta * delta) + 4.0F / 29.0F;
    return 116.0F * f - 16.0F;
}

std::vector<float> normalized(std::vector<float> kernel, float sum) {
    for (float& weight : kernel) weight /= sum;
    return kernel;
}

/// The eye's contrast sensitivity to luminance as a Gaussian: a = 1, b = 0.0047 of the paper.
std::vector<float> sensitivity(float pixelsPerDegree) {
    constexpr float b = 0.0047F;
    const float scale = pi * pi / b;
    const auto reach =
        static_cast<int>(std::ceil(3.0F * std::sqrt(0.04F / (2.0F * pi * pi)) * pixelsPerDegree));
    std::vector<float> kernel;
    float sum = 0.0F;
    for (int k = -reach; k <= reach; ++k) {
        const float x = static_cast<float>(k) / pixelsPerDegree;
        kernel.push_back(std::exp(-scale * x * x));
        sum += kernel.back();
    }
    return normalized(std::move(kernel), sum);
}

struct Features {
    Plane edgeX, edgeY, pointX, pointY;
};

Features features(const Plane& luminance, float pixelsPerDegree) {
    constexpr float width = 0.082F;  // degrees
    const float deviation = 0.5F * width * pixelsPerDegree;
    const auto reach = static_cast<int>(std::ceil(3.0F * deviation));
    std::vector<float> gauss, first, second;
    float sum = 0.0F, half = 0.0F, above = 0.0F, below = 0.0F;
    for (int k = -reach; k <= reach; ++k) {
        const auto x = static_cast<float>(k);
        const float g = std::exp(-x * x / (2.0F * deviation * deviation));
        gauss.push_back(g);
        first.push_back(-x * g);
        second.push_back((x * x / (deviation * deviation) - 1.0F) * g);
        sum += g;
        half += std::max(first.back(), 0.0F);
        (second.back() > 0.0F ? above : below) += std::abs(second.back());
    }
    gauss = normalized(std::move(gauss), sum);
    first = normalized(std::move(first), half);
    // Positive weights sum to 1, negative ones to -1.
    for (float& weight : second) weight /= weight > 0.0F ? above : below;
    return {.edgeX = separable(luminance, first, gauss),
            .edgeY = separable(luminance, gauss, first),
            .pointX = separable(luminance, second, gauss),
            .pointY = separable(luminance, gauss, second)};
}

}  // namespace

Plane flip(const Plane& reference, const Plane& test, float pixelsPerDegree) {
    const auto luminanceOf = [](const Plane& image) {
        Plane y = image;
        for (float& value : y.values) value = linear(value);
        return y;
    };
    const Plane a = luminanceOf(reference);
    const Plane b = luminanceOf(test);
    const auto kernel = sensitivity(pixelsPerDegree);
    const Plane seenA = separable(a, kernel, kernel);
    const Plane seenB = separable(b, kernel, kernel);
    const Features featuresA = features(a, pixelsPerDegree);
    const Features featuresB = features(b, pixelsPerDegree);

    // Exponent and the two-piece map that compresses large differences; the largest possible one is
    // green against blue.
    constexpr float qc = 0.7F, pc = 0.4F, pt = 0.95F, qf = 0.5F;
    const float largest = std::pow(203.3F, qc);  // Hunt-adjusted HyAB of green against blue
    const float knee = pc * largest;
    Plane done = reference;
    for (std::size_t i = 0; i < done.values.size(); ++i) {
        const float apart = std::abs(lightness(std::clamp(seenA.values[i], 0.0F, 1.0F)) -
                                     lightness(std::clamp(seenB.values[i], 0.0F, 1.0F)));
        const float power = std::pow(apart, qc);
        const float color =
            power < knee ? pt / knee * power : pt + (power - knee) / (largest - knee) * (1.0F - pt);
        const auto size = [i](const Plane& x, const Plane& y) {
            return std::hypot(x.values[i], y.values[i]);
        };
        const float edge = std::abs(size(featuresA.edgeX, featuresA.edgeY) -
                                    size(featuresB.edgeX, featuresB.edgeY));
        const float point = std::abs(size(featuresA.pointX, featuresA.pointY) -
                                     size(featuresB.pointX, featuresB.pointY));
        const float feature = std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, qf);
        done.values[i] = std::pow(color, 1.0F - std::min(feature, 1.0F));
    }
    return done;
}

}  // namespace gnomon::truth
