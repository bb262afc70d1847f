#include "Noise.h"

#include <array>
#include <cmath>

namespace gnomon::demo {
namespace {

int wrapped(int i, int cells) {
    const int rest = i % cells;
    return rest < 0 ? rest + cells : rest;
}

float fade(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

float mixed(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

std::uint32_t Noise::hash(int i, int j) const {
    std::uint64_t x = seed_ ^ (std::uint64_t{static_cast<std::uint32_t>(i)} << 32U) ^
                      std::uint64_t{static_cast<std::uint32_t>(j)};
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;  // the finisher of SplitMix64
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return static_cast<std::uint32_t>((x ^ (x >> 31U)) >> 32U);
}

float Noise::cell(int i, int j) const {
    return static_cast<float>(hash(i, j) >> 8U) * (1.0F / 16777216.0F);
}

float Noise::at(float u, float v, int cellsU, int cellsV) const {
    const float x = u * static_cast<float>(cellsU);
    const float y = v * static_cast<float>(cellsV);
    const float left = std::floor(x);
    const float top = std::floor(y);
    const float fx = x - left;
    const float fy = y - top;
    const auto slope = [&](int di, int dj) {
        // Eight directions of equal length are enough once octaves are summed.
        static constexpr float d = 0.70710678F;
        static constexpr std::array<std::array<float, 2>, 8> directions{
            {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {d, d}, {-d, d}, {d, -d}, {-d, -d}}};
        const int i = wrapped(static_cast<int>(left) + di, cellsU);
        const int j = wrapped(static_cast<int>(top) + dj, cellsV);
        const auto& g = directions[hash(i, j) & 7U];
        return g[0] * (fx - static_cast<float>(di)) + g[1] * (fy - static_cast<float>(dj));
    };
    const float upper = mixed(slope(0, 0), slope(1, 0), fade(fx));
    const float lower = mixed(slope(0, 1), slope(1, 1), fade(fx));
    return 1.5F * mixed(upper, lower, fade(fy));
}

float Noise::fractal(float u, float v, int cells, int octaves) const {
    return fractal(u, v, cells, cells, octaves);
}

float Noise::fractal(float u, float v, int cellsU, int cellsV, int octaves) const {
    float sum = 0.0F;
    float strength = 0.5F;
    for (int k = 0; k < octaves; ++k) {
        sum += strength * at(u, v, cellsU << k, cellsV << k);
        strength *= 0.5F;
    }
    return sum;
}

}  // namespace gnomon::demo
