#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Statistics.h"

namespace gnomon::client {
namespace {

using namespace std::chrono_literals;

TEST(Samples, QuantilesAreNearestRanks) {
    Samples samples;
    EXPECT_EQ(samples.median(), 0.0);
    for (int i = 100; i >= 1; --i) samples.add(i);
    EXPECT_EQ(samples.median(), 50.0);
    EXPECT_EQ(samples.quantile(0.99), 99.0);
    EXPECT_EQ(samples.max(), 100.0);
    EXPECT_EQ(samples.quantile(0.0), 1.0);
}

TEST(Statistics, TellWhatTheFramesWereLike) {
    Statistics statistics;
    std::vector<net::ServerStatus> servers(2);
    servers[0].address.name = "left";
    servers[0].state = net::ServerState::member;
    servers[0].stats.renderMs = 4.0F;
    servers[0].lost = 2;
    servers[1].address.name = "right";
    const auto begun = Statistics::Clock::time_point{} + 1h;
    for (std::uint64_t i = 0; i < 101; ++i) {
        const auto now = begun + i * 20ms;
        statistics.add(
            {.n = i + 1, .shown = i, .ms = 15.0, .skewMs = 0.5, .waitedFor = "left", .bytes = 96},
            servers, now);
        EXPECT_EQ(statistics.line(now).has_value(), i == 50 || i == 100) << i;
    }
    const auto json = statistics.json(servers, {});
    EXPECT_EQ(json["frames"], 101);
    EXPECT_NEAR(json["frame_ms"]["median"].get<double>(), 20.0, 1e-3);
    EXPECT_NEAR(json["frame_ms"]["max"].get<double>(), 20.0, 1e-3);
    EXPECT_NEAR(json["frame_ms"]["p99"].get<double>(), 20.0, 1e-3);
    EXPECT_EQ(json["skew_ms"]["median"], 0.5);
    EXPECT_EQ(json["bytes_per_frame"], 96.0);
    ASSERT_EQ(json["servers"].size(), 2U);
    EXPECT_EQ(json["servers"][0]["name"], "left");
    EXPECT_EQ(json["servers"][0]["frame_ms"], 4.0);
    EXPECT_EQ(json["servers"][0]["lost"], 2);
    EXPECT_EQ(json["servers"][1]["frame_ms"], 0.0);
}

}  // namespace
}  // namespace gnomon::client
