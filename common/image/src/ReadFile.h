#pragma once

#include <gnomon/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace gnomon::image {

/// The whole file. Errors (Errc::file): missing, unreadable, more than @p limit bytes.
Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& path, std::size_t limit);

}  // namespace gnomon::image
