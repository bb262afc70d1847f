#pragma once

#include <vector>

namespace gnomon::bench {

/// What the machine allows: the exchange of an idle frame (52 bytes to each server, 116 back) with
/// processes that do nothing else, by bare system calls. Microseconds from frame to frame.
std::vector<double> floorOf(int servers, double seconds);

}  // namespace gnomon::bench
