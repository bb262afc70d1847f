#include "BackgroundWriter.h"

#include <fmt/format.h>
#include <gnomon/base/Error.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

namespace gnomon::client {
namespace {

constexpr std::size_t most = std::size_t{1} << 20U;
/// A pipe that poll() calls writable takes so many bytes at once: PIPE_BUF of Linux.
constexpr std::size_t atOnce = 4096;

}  // namespace

BackgroundWriter::BackgroundWriter(int fd, OnFailure onFailure)
    : fd_{fd}, wake_{::eventfd(0, EFD_CLOEXEC)}, onFailure_{std::move(onFailure)} {
    if (wake_ < 0)
        throw Failure{Error{.code = Errc::process,
                            .what = "cannot make an eventfd for what is said",
                            .cause = {errno, std::generic_category()}}};
    thread_ = std::thread{[this] { run(); }};
}

BackgroundWriter::~BackgroundWriter() {
    {
        std::unique_lock lock{mutex_};
        ending_ = true;
        changed_.notify_all();
        changed_.wait_for(lock, std::chrono::seconds{1}, [&] { return ended_; });
    }
    giveUp_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);
    thread_.join();
    ::close(wake_);
    ::close(fd_);
}

void BackgroundWriter::write(std::string text) {
    const std::lock_guard lock{mutex_};
    if (bytes_ + text.size() > most) {
        ++leftOut_;
        return;
    }
    bytes_ += text.size();
    texts_.push_back(std::move(text));
    changed_.notify_all();
}

/// Empty at the end.
std::string BackgroundWriter::next() {
    std::unique_lock lock{mutex_};
    changed_.wait(lock, [&] { return ending_ || !texts_.empty() || leftOut_ > 0; });
    if (texts_.empty() && leftOut_ > 0)
        return fmt::format("({} lines left out: nobody took them)\n", std::exchange(leftOut_, 0U));
    if (texts_.empty()) return {};
    std::string text = std::move(texts_.front());
    texts_.pop_front();
    bytes_ -= text.size();
    return text;
}

void BackgroundWriter::run() {
    for (auto text = next(); !text.empty() && !giveUp_; text = next()) {
        if (put(text)) {
            failed_ = false;
            continue;
        }
        const std::error_code why{errno, std::generic_category()};
        if (!std::exchange(failed_, true) && !giveUp_ && onFailure_) onFailure_(why.message());
    }
    const std::lock_guard lock{mutex_};
    ended_ = true;
    changed_.notify_all();
}

/// False, with errno, where it cannot be written.
bool BackgroundWriter::put(const std::string& text) {
    for (std::size_t from = 0; from < text.size();) {
        if (!waitForRoom()) return false;
        const auto written = ::write(fd_, text.data() + from, std::min(text.size() - from, atOnce));
        if (written < 0 && errno != EINTR && errno != EAGAIN) return false;
        if (written > 0) from += static_cast<std::size_t>(written);
    }
    return true;
}

bool BackgroundWriter::waitForRoom() const {
    std::array<pollfd, 2> entries{{{fd_, POLLOUT, 0}, {wake_, POLLIN, 0}}};
    while (::poll(entries.data(), entries.size(), -1) < 0 && errno == EINTR) {
    }
    return !giveUp_;
}

}  // namespace gnomon::client
