#include "ReadFile.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>

#include "AtomicFile.h"

namespace gnomon::image {

Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& path, std::size_t limit) {
    const auto failed = [&] {
        return fail(Errc::file, "cannot read " + path.string(), {errno, std::generic_category()});
    };
    const File file{std::fopen(path.c_str(), "rbe")};
    if (!file) return failed();
    // Grown as bytes arrive: a pipe has no size to ask for, and a stated one may be wrong.
    constexpr std::size_t chunk = std::size_t{1} << 16U;
    std::vector<std::uint8_t> bytes;
    for (;;) {
        const auto had = bytes.size();
        if (had > limit)
            return fail(Errc::file, fmt::format("cannot read {}: it has more than {} bytes",
                                                path.string(), limit));
        bytes.resize(std::max(had + chunk, had + had / 2));
        const auto got = std::fread(bytes.data() + had, 1, bytes.size() - had, file.get());
        bytes.resize(had + got);
        if (std::ferror(file.get()) != 0) return failed();
        if (got == 0) return bytes;
    }
}

}  // namespace gnomon::image
