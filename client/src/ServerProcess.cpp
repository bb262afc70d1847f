#include "ServerProcess.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace gnomon::client {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds shortestPause = 100ms;
constexpr std::chrono::milliseconds longestPause = 5s;
constexpr auto longEnough = 10s;  // a server that ran so long starts with the shortest pause again

/// The port in "port 12345".
std::optional<std::uint16_t> portOf(const std::string& line) {
    constexpr std::string_view word = "port ";
    if (line.compare(0, word.size(), word) != 0) return {};
    std::uint16_t port = 0;
    const char* last = line.data() + line.size();
    const auto read = std::from_chars(line.data() + word.size(), last, port);
    if (read.ec != std::errc{} || read.ptr != last || port == 0) return {};
    return port;
}

bool readable(int fd) {
    pollfd entry{fd, POLLIN, 0};
    return ::poll(&entry, 1, 0) > 0;
}

}  // namespace

bool LineReader::fill(int fd) {
    std::array<char, 4096> buffer{};
    const auto got = ::read(fd, buffer.data(), buffer.size());
    if (got > 0) pending_.append(buffer.data(), static_cast<std::size_t>(got));
    return got > 0;
}

template <class OnLine>
bool LineReader::read(int fd, OnLine&& onLine) {
    const bool open = fill(fd);
    std::size_t from = 0;
    while (from < pending_.size()) {
        auto end = pending_.find('\n', from);
        // The end of the pipe ends a line; so does one that is too long.
        if (end == std::string::npos && open && pending_.size() - from < longest) break;
        end = std::min({end, pending_.size(), from + longest});
        if (end > from) onLine(pending_.substr(from, end - from));
        from = end < pending_.size() && pending_[end] == '\n' ? end + 1 : end;
    }
    pending_.erase(0, from);
    return open;
}

ServerProcess::ServerProcess(ServerProcess&& other) noexcept
    : command_{std::move(other.command_)},
      options_{other.options_},
      child_{std::move(other.child_)},
      pidfd_{std::exchange(other.pidfd_, -1)},
      outputOpen_{other.outputOpen_},
      errorsOpen_{other.errorsOpen_},
      reported_{other.reported_},
      outputLines_{std::move(other.outputLines_)},
      errorLines_{std::move(other.errorLines_)},
      lastLine_{std::move(other.lastLine_)},
      why_{std::move(other.why_)},
      startedAt_{other.startedAt_},
      due_{other.due_},
      pause_{other.pause_} {}

ServerProcess::~ServerProcess() {
    if (pidfd_ >= 0) ::close(pidfd_);
}

void ServerProcess::log(LogLevel level, const std::string& text) const {
    if (options_.log) options_.log(level, fmt::format("{}: {}", command_.server, text));
}

std::optional<ServerProcess::Clock::time_point> ServerProcess::due() const noexcept {
    if (child_) return {};
    return due_;
}

Result<void> ServerProcess::startIfDue(Clock::time_point now) {
    if (child_ || now < due_) return {};
    auto child = Child::start(
        {.arguments = command_.arguments, .environment = command_.environment, .takesInput = true});
    startedAt_ = now;
    if (!child) {
        due_ = now + pause_;
        pause_ = std::min(pause_ * 2, longestPause);
        return tl::unexpected{child.error()};
    }
    child_ = *std::move(child);
    pidfd_ = static_cast<int>(::syscall(SYS_pidfd_open, child_->pid(), 0));
    outputOpen_ = true;
    errorsOpen_ = true;
    reported_ = false;
    outputLines_ = {};
    errorLines_ = {};
    lastLine_.clear();
    if (why_.empty())
        log(LogLevel::debug, fmt::format("started as process {}", child_->pid()));
    else
        log(LogLevel::warning, fmt::format("{}; started again", why_));
    return {};
}

void ServerProcess::onOutputLine(const std::string& line) {
    const auto port = reported_ ? std::nullopt : portOf(line);
    if (!port) {
        log(LogLevel::info, line);
        return;
    }
    reported_ = true;
    if (options_.listening) options_.listening(command_.server, *port);
}

void ServerProcess::readOutput() {
    outputOpen_ = outputLines_.read(output(), [&](const std::string& line) { onOutputLine(line); });
}

void ServerProcess::readErrors() {
    errorsOpen_ = errorLines_.read(errors(), [&](const std::string& line) {
        // It says who it is; here that is known.
        const std::string self = fmt::format("gnomon-server {}: ", command_.server);
        lastLine_ = line.compare(0, self.size(), self) == 0 ? line.substr(self.size()) : line;
        log(LogLevel::info, lastLine_);
    });
}

std::optional<int> ServerProcess::reap(Clock::time_point now) {
    if (!child_) return {};
    const auto status = child_->ended();
    if (!status) return {};
    // Its last words; a process it may have left behind cannot hold us up.
    while (output() >= 0 && readable(output())) readOutput();
    while (errors() >= 0 && readable(errors())) readErrors();
    why_ = fmt::format("ended with {}{}{}", describeStatus(*status), lastLine_.empty() ? "" : ": ",
                       lastLine_);
    child_.reset();
    if (pidfd_ >= 0) ::close(std::exchange(pidfd_, -1));
    if (now - startedAt_ > longEnough) pause_ = shortestPause;
    due_ = now + pause_;
    pause_ = std::min(pause_ * 2, longestPause);
    return status;
}

}  // namespace gnomon::client
