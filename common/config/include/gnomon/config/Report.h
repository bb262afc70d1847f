#pragma once

#include <gnomon/config/Config.h>

#include <string>
#include <vector>

namespace gnomon::config {

/// All that is wrong or doubtful with a configuration, in file order: validate(), and what only
/// shows in the whole: names, hosts and ports, geometry, who shows what.
std::vector<Finding> findings(const Config& config);

/// Who shows what, as text: a table of servers, then the screens with their fit groups.
/// @pre findings(config) has no error
std::string describe(const Config& config);

/// The same as a picture (SVG): each screen with its tiles, a colour for each host, and the room
/// from above. @pre findings(config) has no error
std::string svg(const Config& config);

}  // namespace gnomon::config
