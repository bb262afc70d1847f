#pragma once

#include <istream>
#include <string>
#include <vector>

#include "Plot.h"

/// What `gnomon run --trace` wrote, as a drawing.
namespace gnomon::client {

struct TraceRow {
    std::uint64_t frame = 0;
    double s = 0.0;
    double ms = 0.0;
    int members = 0;
    std::string dropped = {};  ///< names, separated by spaces
    std::string joined = {};
};

/// Rows of FrameTrace. The first line of a column's names is expected as FrameTrace::header.
Result<std::vector<TraceRow>> readTrace(std::istream& in);

/// Time to the right, time from frame to frame upward (logarithmic): of each pixel's frames the
/// median and the longest. Below, how many servers showed them; who was dropped and who came back.
Plot plotOf(const std::vector<TraceRow>& rows, const std::string& title);

}  // namespace gnomon::client
