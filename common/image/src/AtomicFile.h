#pragma once

#include <gnomon/base/Error.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

namespace gnomon::image {

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// A file that appears under its name only once it is complete: written beside it, then renamed
/// over it. What is not a regular file (/dev/null, a pipe) is written to directly.
class AtomicFile {
public:
    static Result<AtomicFile> create(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept
        : file_{std::move(other.file_)},
          target_{std::move(other.target_)},
          temporary_{std::exchange(other.temporary_, {})} {}
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;

    std::FILE* stream() const noexcept { return file_.get(); }
    /// Puts the file in its place. Without this, or when it fails, nothing is left behind.
    Result<void> commit();

private:
    AtomicFile() = default;

    File file_;
    std::filesystem::path target_;
    std::filesystem::path temporary_;  // empty if written directly
};

}  // namespace gnomon::image
