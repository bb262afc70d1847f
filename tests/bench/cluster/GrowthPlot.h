#pragma once

#include <string>
#include <vector>

#include "Cases.h"

namespace gnomon::bench {

/// Time from frame to frame against the number of servers, both logarithmic, a line for each case
/// with each relay setting. An SVG.
std::string growthSvg(const std::vector<Row>& rows);

/// The rows as a Markdown table: cases down, numbers of servers across, medians (99th percentiles).
std::string markdown(const std::vector<Row>& rows);

}  // namespace gnomon::bench
