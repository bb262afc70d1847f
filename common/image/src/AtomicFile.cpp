#include "AtomicFile.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace gnomon::image {
namespace {

std::error_code lastError() { return {errno, std::generic_category()}; }

tl::unexpected<Error> cannotWrite(const std::filesystem::path& path, std::error_code cause) {
    return fail(Errc::file, "cannot write " + path.string(), cause);
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
    std::error_code ec;
    AtomicFile made;
    made.target_ = path;
    const auto status = std::filesystem::status(path, ec);
    if (std::filesystem::exists(status)) {
        // A link stays a link: what it leads to is replaced.
        auto real = std::filesystem::canonical(path, ec);
        if (!ec) made.target_ = std::move(real);
    }
    int descriptor = -1;
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        // Not mkstemp: that one ignores the user's umask. Numbers free a name another thread has.
        for (int i = 0; i < 1000; ++i) {
            made.temporary_ = made.target_;
            made.temporary_ += fmt::format(".{}-{}.tmp", ::getpid(), i);
            descriptor =
                ::open(made.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor >= 0 || errno != EEXIST) break;
        }
    }
    if (descriptor < 0) {
        const auto cause = lastError();
        made.temporary_.clear();  // not ours
        return cannotWrite(path, cause);
    }
    made.file_.reset(::fdopen(descriptor, "wb"));
    if (!made.file_) {
        const auto cause = lastError();
        ::close(descriptor);
        return cannotWrite(path, cause);
    }
    return made;
}

AtomicFile::~AtomicFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<void> AtomicFile::commit() {
    errno = 0;
    const bool failedBefore = std::ferror(file_.get()) != 0;
    const bool closed = std::fclose(file_.release()) == 0;
    if (failedBefore || !closed)
        return cannotWrite(target_,
                           errno != 0 ? lastError() : std::make_error_code(std::errc::io_error));
    if (temporary_.empty()) return {};
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        return cannotWrite(target_, lastError());
    temporary_.clear();
    return {};
}

}  // namespace gnomon::image
