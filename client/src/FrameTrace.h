#pragma once

#include <gnomon/net/HubTypes.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::client {

/// A line of CSV for each frame: which frame was shown, when, how long after the one before, by how
/// many servers, and who was dropped or took part. A full disk ends the trace, not the run.
class FrameTrace {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr const char* header = "frame,s,ms,members,dropped,joined";

    /// @param warn  is told once if the file cannot be written on
    /// @throws Failure Errc::file
    FrameTrace(const std::filesystem::path& file, std::function<void(const std::string&)> warn);

    void add(const net::FrameResult& frame, const std::vector<net::ServerStatus>& servers,
             Clock::time_point now);
    /// Writes what waits.
    void finish();

private:
    void giveUp();

    std::filesystem::path file_;
    std::function<void(const std::string&)> warn_;
    std::ofstream out_;
    std::optional<Clock::time_point> first_ = {}, last_ = {};
    bool over_ = false;  // could not be written on
};

/// Names of servers as one field of CSV, separated by spaces.
std::string csvField(const std::vector<std::string>& names);

}  // namespace gnomon::client
