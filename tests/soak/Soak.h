#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::soak {

struct SoakOptions {
    std::filesystem::path wall = {};    ///< a TOML file
    double timeout = 1.0;               ///< seconds, instead of the wall's sync.timeout
    std::filesystem::path server = {};  ///< gnomon-server
    std::uint64_t frames = 100'000;
    std::uint64_t faultEvery = 2000;  ///< frames
    int changes = 20;                 ///< each frame
    unsigned seed = 1;
    std::filesystem::path csv = {};  ///< empty: none is written
};

/// What there is of each at a moment.
struct Sample {
    std::uint64_t frame = 0;
    double s = 0.0;
    long clientKib = 0;
    int clientFiles = 0;
    long serverKib = 0;  ///< of the one server that nothing happens to
    int serverFiles = 0;
    long mostKib = 0;   ///< of all servers
    int mostFiles = 0;  ///< likewise
    std::size_t things = 0;
    int zombies = 0;
};

struct Outcome {
    std::vector<Sample> samples = {};
    std::uint64_t frames = 0;
    double medianMs = 0.0, longestMs = 0.0, seconds = 0.0;
    int faults = 0;
    std::uint32_t lost = 0, rejoined = 0;
    int drifts = 0;
    int filesBefore = 0, filesAfter = 0;  ///< of the client, before the wall and after it
    int children = 0;  ///< processes of the client's, ended or not, after the end
};

/// Drives a wall of null-render servers through edits, kills and stops. @throws Failure
Outcome soak(const SoakOptions& options);

/// What is wrong with it, a line each; empty: nothing.
std::vector<std::string> complaints(const Outcome& outcome);

}  // namespace gnomon::soak
