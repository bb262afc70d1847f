#pragma once

#include <filesystem>
#include <string>

namespace gnomon::client {

/// @throws Failure Errc::file
void writeText(const std::filesystem::path& file, const std::string& text);
/// With all folders above it; nothing where it is there already. @throws Failure Errc::file
void makeFolder(const std::filesystem::path& folder);

}  // namespace gnomon::client
