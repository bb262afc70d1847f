#pragma once

#include <gnomon/config/Place.h>

#include <optional>
#include <string_view>

namespace gnomon::config {

inline constexpr int maxKeyParts = 16;

/// Where a dotted key (`a.b.c`) first has more than maxKeyParts parts. The TOML library limits
/// nested values but not these, makes a table of each part and frees them by recursion: half a
/// million overflow the stack.
std::optional<Place> keyOfManyParts(std::string_view text);

}  // namespace gnomon::config
