#pragma once

#include <gnomon/config/Config.h>

#include <vector>

/// What findings() looks for beyond validate(), a file each.
namespace gnomon::config {

/// Names used twice, two servers on one host and port, full-screen windows on one monitor.
void checkServers(const Config& config, std::vector<Finding>& findings);

/// Viewports of unknown screens or tiles; tiles missing, shown twice, or of different sizes.
/// @pre validate(config) has no error
void checkCover(const Config& config, std::vector<Finding>& findings);

/// Canvases, the shape of pixels, and the head in front of each screen.
/// @pre validate(config) has no error
void checkGeometry(const Config& config, std::vector<Finding>& findings);

}  // namespace gnomon::config
