#pragma once

#include <gnomon/truth/ShadowError.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "Flicker.h"

/// What `gnomon bench` found.
namespace gnomon::client {

/// A median, with the 95 % interval that order statistics give it, whatever the distribution.
struct Interval {
    double median = 0.0, low = 0.0, high = 0.0;
};
Interval medianOf(std::vector<double> values);

/// One technique with one size of map.
struct BenchRow {
    std::string technique = {};  ///< its label
    int mapSize = 0;
    bool peer = false;  ///< another project's program
    Interval frameMs = {};
    Interval ratio = {};  ///< of frame times to the first row's, in pairs
    truth::ShadowError error = {};
    std::array<double, 3> bands = {};  ///< wrong shares of the near, middle and far third
    std::optional<FlickerError> cameraFlicker = {};
    std::optional<FlickerError> lightFlicker = {};
    std::uint64_t triangles = 0;
    std::uint64_t mapTexels = 0;  ///< drawn in a frame
    std::uint64_t mapBytes = 0;   ///< held
    int degenerate = 0;
    std::string picture = {};  ///< of the error: a file beside the report

    double wrongPercent() const noexcept { return 100.0 * error.share(error.wrong); }
};

/// What was compared with each other, frame by frame.
struct BenchTable {
    std::string chapter = {};  ///< of a sweep
    std::string scene = {};
    std::string view = {};
    std::string renderer = {};
    int width = 0, height = 0;
    bool dynamic = false;
    int frames = 0;
    std::vector<BenchRow> rows = {};

    /// For people: "plaza.glb, light across, 1024 x 1024, static".
    std::string title() const;
    /// For files: letters, digits and hyphens.
    std::string slug() const;
};

/// Rows that no other row beats: none is both as fast and as right, and better in one of the two.
/// As fast by the ratio: it is of pairs, and so the machine's mood is not in it.
/// Rows without shadows take part as what they are: fast, and wrong.
std::vector<bool> paretoFront(const std::vector<BenchRow>& rows);

/// Letters, digits and hyphens of a text.
std::string slugOf(const std::string& text);

}  // namespace gnomon::client
