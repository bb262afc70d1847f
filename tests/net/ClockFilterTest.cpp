#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "ClockFilter.h"

namespace gnomon::net {
namespace {

TEST(ClockFilter, KnowsNothingBeforeTheFirstPing) {
    EXPECT_FALSE(ClockFilter{}.known());
    EXPECT_FALSE(ClockFilter{}.offset());
}

TEST(ClockFilter, FindsTheOffsetWithinHalfTheShortestTrip) {
    constexpr std::int64_t offset = 5'000'000'000;
    std::mt19937 random{1};
    ClockFilter filter;
    std::int64_t now = 1'000'000;
    std::int64_t shortest = 1'000'000'000;
    for (int i = 0; i < 16; ++i) {
        const std::int64_t there = 20'000 + static_cast<std::int64_t>(random() % 3'000'000);
        const std::int64_t back = 20'000 + static_cast<std::int64_t>(random() % 3'000'000);
        filter.add(now, now + there + offset, now + there + back);
        shortest = std::min(shortest, there + back);
        now += 250'000'000;
    }
    EXPECT_EQ(filter.trip(), shortest);
    EXPECT_LE(std::abs(*filter.offset() - offset), shortest / 2);
}

// Found by a fuzzer: a sum that no integer holds.
TEST(ClockFilter, TakesWhateverAServerSaysItsClockIs) {
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    constexpr auto least = std::numeric_limits<std::int64_t>::min();
    for (const std::int64_t server : {most, least, most - 5, std::int64_t{-1}}) {
        ClockFilter filter;
        filter.add(100, server, 200);
        ASSERT_TRUE(filter.offset());
        // What it says next, by the same clock, is so much later by ours.
        EXPECT_EQ(clockDifference(clockDifference(server, -10), *filter.offset()), 160);
    }
}

TEST(ClockFilter, ForgetsOldTrips) {
    ClockFilter filter;
    filter.add(0, 1000, 2);  // short, but old and of another offset
    for (std::int64_t i = 1; i <= 16; ++i) filter.add(i * 100, i * 100 + 7, i * 100 + 10);
    EXPECT_EQ(filter.offset(), 2);
}

}  // namespace
}  // namespace gnomon::net
