#include "input/Files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "input/Report.h"

namespace gnomon::importer {
namespace {

struct Descriptor {
    int fd = -1;
    explicit Descriptor(int value) : fd{value} {}
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
};

}  // namespace

Result<Bytes> readRegularFile(const std::filesystem::path& path, std::uint64_t limit) {
    // O_NONBLOCK: opening a pipe without a writer would otherwise wait for ever.
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
    struct stat status {};
    if (file.fd < 0 || ::fstat(file.fd, &status) != 0)
        return fail(Errc::file, "cannot be opened", {errno, std::generic_category()});
    if (!S_ISREG(status.st_mode)) return fail(Errc::file, "is not a regular file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > limit)
        return fail(Errc::limit, fmt::format("has {} bytes, the limit is {}", size, limit));
    Bytes bytes(static_cast<std::size_t>(size));
    std::size_t got = 0;
    while (got < bytes.size()) {
        const auto count = ::read(file.fd, bytes.data() + got, bytes.size() - got);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return fail(Errc::file, "cannot be read", {errno, std::generic_category()});
        if (count == 0) break;  // became shorter meanwhile
        got += static_cast<std::size_t>(count);
    }
    bytes.resize(got);
    return bytes;
}

Folder::Folder(const std::filesystem::path& model) {
    std::error_code ec;
    const auto whole = std::filesystem::absolute(model, ec);
    folder_ = std::filesystem::weakly_canonical(whole.parent_path(), ec);
}

Result<std::filesystem::path> Folder::locate(std::string_view name) const {
    const auto refused = [&](std::string_view why) {
        return fail(Errc::file, fmt::format("\"{}\" is not read: {}", printable(name), why));
    };
    if (name.empty()) return refused("the name is empty");
    if (name.find('\0') != std::string_view::npos) return refused("the name contains a NUL");
    const std::filesystem::path relative{name};
    if (relative.is_absolute()) return refused("only files below the model's folder are");
    if (std::find(relative.begin(), relative.end(), "..") != relative.end())
        return refused("the name contains \"..\"; only files below the model's folder are");
    std::error_code ec;
    auto whole = std::filesystem::weakly_canonical(folder_ / relative, ec);
    if (ec) return refused(ec.message());
    const auto [end, rest] =
        std::mismatch(folder_.begin(), folder_.end(), whole.begin(), whole.end());
    if (end != folder_.end() || rest == whole.end())
        return refused("it leads out of the model's folder");
    return whole;
}

Result<std::shared_ptr<const Bytes>> Folder::read(std::string_view name) {
    const auto path = locate(name);
    if (!path) return tl::unexpected{path.error()};
    auto& kept = read_[path->string()];
    if (!kept) {
        auto bytes = readRegularFile(*path, maxFileBytes - std::min(total_, maxFileBytes));
        if (!bytes) {
            Error error = std::move(bytes).error();
            error.what = fmt::format("\"{}\" {}", printable(name), error.what);
            return tl::unexpected{std::move(error)};
        }
        total_ += bytes->size();
        kept = std::make_shared<const Bytes>(*std::move(bytes));
    }
    return kept;
}

}  // namespace gnomon::importer
