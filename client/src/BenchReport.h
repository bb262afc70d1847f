#pragma once

#include <gnomon/truth/ShadowError.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// What `gnomon bench` found, as tables and plots.
namespace gnomon::client {

/// A median, with the 95 % interval that order statistics give it, whatever the distribution.
struct Interval {
    double median = 0.0, low = 0.0, high = 0.0;
};
Interval medianOf(std::vector<double> values);

/// One technique with one size of map.
struct BenchRow {
    std::string technique = {};
    int mapSize = 0;
    Interval frameMs = {};
    Interval ratio = {};  ///< of frame times to the first row's, in pairs
    truth::ShadowError error = {};
    std::uint64_t triangles = 0;
    std::uint64_t mapTexels = 0;  ///< drawn in a frame
    std::uint64_t mapBytes = 0;   ///< held
    int degenerate = 0;
    std::string picture = {};  ///< of the error: a file beside the report
};

struct BenchTable {
    std::string scene = {};
    std::string renderer = {};
    int width = 0, height = 0;
    bool dynamic = false;
    int frames = 0;
    std::vector<BenchRow> rows = {};
};

/// Rows that no other row beats: none is both as fast and as right, and better in one of the two.
/// Rows without shadows take part as what they are: fast, and wrong.
std::vector<bool> paretoFront(const std::vector<BenchRow>& rows);

std::string benchCsv(const BenchTable& table);
std::string benchJson(const BenchTable& table);
/// Run time to the right, wrong pixels upward (logarithmic), intervals and the front drawn in.
std::string benchSvg(const BenchTable& table);
/// A page with the plot, the table, and the pictures; needs no server and nothing from elsewhere.
std::string benchHtml(const BenchTable& table);

/// plot.svg, table.csv, table.json and index.html into a folder, made where missing.
/// @throws Failure Errc::file
void writeBenchReport(const std::filesystem::path& folder, const BenchTable& table);

}  // namespace gnomon::client
