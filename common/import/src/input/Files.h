#pragma once

#include <gnomon/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::importer {

using Bytes = std::vector<std::byte>;

/// Largest file that is read, and the most all files of one model may hold together.
inline constexpr std::uint64_t maxFileBytes = std::uint64_t{2} << 30U;

/// A regular file's content. Devices, pipes and folders are not opened for reading.
Result<Bytes> readRegularFile(const std::filesystem::path& path, std::uint64_t limit);

/// The folder a model lies in: the only place its side files are read from.
class Folder {
public:
    explicit Folder(const std::filesystem::path& model);

    /// Where a relative path from a model leads, if that is inside the folder, also after following
    /// links; else why not. @p name is plain text with '/' between parts, not a URI.
    Result<std::filesystem::path> locate(std::string_view name) const;
    /// Its content; the same object for the same file. Errors name the file.
    Result<std::shared_ptr<const Bytes>> read(std::string_view name);

private:
    std::filesystem::path folder_;  // canonical
    std::unordered_map<std::string, std::shared_ptr<const Bytes>> read_;
    std::uint64_t total_ = 0;
};

inline std::string_view asText(std::span<const std::byte> bytes) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace gnomon::importer
