#pragma once

#include <gnomon/net/HubTypes.h>

#include <chrono>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::client {

/// Many measured values of one kind; keeps the newest million.
class Samples {
public:
    void add(double value);
    bool empty() const noexcept { return values_.empty(); }
    std::size_t size() const noexcept { return values_.size(); }
    /// The value below which @p share (0..1) of them lie: nearest rank. 0 where there is none.
    double quantile(double share) const;
    double median() const { return quantile(0.5); }
    double max() const { return quantile(1.0); }
    void clear() { values_.clear(); }

private:
    static constexpr std::size_t most = 1U << 20U;
    std::vector<float> values_ = {};
    std::size_t next_ = 0;  // the oldest, once there are as many as are kept
};

/// What a run tells about its frames: a line a second, and all of it as JSON.
class Statistics {
public:
    using Clock = std::chrono::steady_clock;

    /// One frame was handed over and, pipelined, an earlier one shown. @p now its return.
    void add(const net::FrameResult& frame, const std::vector<net::ServerStatus>& servers,
             Clock::time_point now);
    /// What was seen since the last line, at most one a second.
    std::optional<std::string> line(Clock::time_point now);

    std::uint64_t frames() const noexcept { return frames_; }
    /// One line about all of it.
    std::string summary() const;
    /// frames, frame_ms, skew_ms, bytes_per_frame, servers: architecture, section 9.
    nlohmann::json json(const std::vector<net::ServerStatus>& servers,
                        const net::HubTotals& totals) const;

private:
    std::uint64_t frames_ = 0;
    std::optional<Clock::time_point> lastFrame_ = {};
    std::optional<Clock::time_point> lastLine_ = {};
    Samples frameMs_ = {};    // from one frame to the next
    Samples latencyMs_ = {};  // from sending a frame to its swap
    Samples skewMs_ = {};
    double bytes_ = 0.0;
    double payloadBytes_ = 0.0;
    std::map<std::string, Samples> renderMs_ = {};  // by server

    Samples recentMs_ = {};  // since the last line
    Samples recentSkew_ = {};
    double recentBytes_ = 0.0;
    std::uint64_t recentFrames_ = 0;
    std::map<std::string, std::uint64_t> recentLast_ = {};  // who was ready last, how often
};

}  // namespace gnomon::client
