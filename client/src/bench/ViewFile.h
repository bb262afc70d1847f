#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "Plan.h"

namespace gnomon::client {

/// Named views, JSON lines as camera paths are: `{"name": "near", "scene": "plaza", "eye": [x,y,z],
/// "center": [x,y,z], "up": [x,y,z], "fovy": deg, "near": m, "far": m, "sun": [x,y,z,deg]}`. Keys
/// and units are those of the command line's options; a light is a list of numbers, several lights
/// of a kind a list of lists. All but the name may be left out; blank lines and those that begin
/// with `#` are passed over.
///
/// Errors (Errc::file) begin with file:line: no object, an unknown key, a value out of range, a
/// name that was there before.
Result<std::vector<BenchView>> loadViews(const std::filesystem::path& file);
Result<std::vector<BenchView>> parseViews(std::string_view text, std::string_view filename);

}  // namespace gnomon::client
