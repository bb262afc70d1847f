#pragma once

#include <cstdint>

namespace gnomon::demo {

/// PCG32: the same numbers for a seed on every platform, which the distributions of <random> do
/// not promise.
///
/// Source: Melissa O'Neill. PCG: A Family of Simple Fast Space-Efficient Statistically Good
/// Algorithms for Random Number Generation. 2014
class Random {
public:
    /// Different @p stream values give independent sequences for one seed.
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
        : increment_{(stream << 1U) | 1U} {
        next();
        state_ += seed;
        next();
    }

    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ULL + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
        const auto rotation = static_cast<std::uint32_t>(old >> 59U);
        return (shifted >> rotation) | (shifted << ((32U - rotation) & 31U));
    }

    /// In [0, 1).
    float unit() { return static_cast<float>(next() >> 8U) * (1.0F / 16777216.0F); }
    /// In [low, high).
    float between(float low, float high) { return low + (high - low) * unit(); }

private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

}  // namespace gnomon::demo
