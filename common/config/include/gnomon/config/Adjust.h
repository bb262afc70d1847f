#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/config/Config.h>

namespace gnomon::config {

/// The same wall with tiles of @p width x @p height pixels: windows, pixel rectangles, overlaps
/// and positions are scaled, full screen is turned off. Errc::config if the result is no valid
/// wall, e.g. when a window holds tiles of two sizes that cannot both become this one.
Result<Config> withTileSize(const Config& config, int width, int height);

/// The same wall as local processes: every host is localhost, with a port and a GPU of the
/// system's choice, no [cluster], no full screen, windows arranged(), and timeouts of at least a
/// quarter of a second a server for a frame and ten seconds a server for the start.
Config localized(const Config& config);

/// Windows placed on the desktop as their tiles lie on the wall: screens side by side, of each
/// the mono or left picture first, then the right one.
Config arranged(const Config& config);

}  // namespace gnomon::config
