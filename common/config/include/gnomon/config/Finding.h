#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/config/Place.h>

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::config {

/// A warning is a wall that can be run but probably is not what was meant.
enum class Level : std::uint8_t { warning, error };

/// Something wrong with a configuration. `what` is one line.
struct Finding {
    Level level = Level::error;
    Place place = {};
    std::string what = {};

    /// "wall.toml:12:18: screen "front": ..."; a warning says so after the position.
    std::string text() const;
};

bool hasError(const std::vector<Finding>& findings);

/// All errors as one Error on one line: the first, and how many more there are. The caller asks
/// only if hasError().
Error toError(const std::vector<Finding>& findings);

}  // namespace gnomon::config
