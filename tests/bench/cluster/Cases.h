#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Cluster.h"

namespace gnomon::bench {

/// One case with one number of servers.
struct Row {
    std::string name = {};  ///< of the case
    int servers = 0;
    int pipeline = 0;
    int relay = 0;
    bool tls = false;
    std::size_t samples = 0;
    double median = 0, p99 = 0;  ///< microseconds from frame to frame
    double bytes = 0;            ///< that the median moved, to all servers together; 0: not told
};

/// The cases by name.
/// - `floor`: see floorOf().
/// - `idle`: a frame in which nothing changes: Frame and Swap to each server, Ready from each.
/// - a number: a frame in which so many transforms change; their edits and the commit included.
/// - `bulk`: a frame that brings a payload of 100 MiB.
/// - `sync`: from the first connection until all take part with a scene of 10,000 nodes.
Row measure(const std::string& name, const ClusterOptions& options, double seconds);

}  // namespace gnomon::bench
