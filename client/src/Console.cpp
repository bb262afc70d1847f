#include "Console.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gnomon/base/Error.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <system_error>

namespace gnomon::client {
namespace {

std::size_t terminalWidth(std::FILE* out) {
    winsize size{};
    return ::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// "2026-03-01 14:05:09.123", local time.
std::string timeNow() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
    const auto seconds = static_cast<std::time_t>(ms / 1000);
    std::tm parts{};
    ::localtime_r(&seconds, &parts);
    return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03}", parts, ms % 1000);
}

int openLog(const std::string& file) {
    const int made = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (made >= 0) return made;
    throw Failure{Error{.code = Errc::file,
                        .what = file + ": cannot be written",
                        .cause = {errno, std::generic_category()}}};
}

}  // namespace

Console::Console(std::FILE* out) : out_{out}, terminal_{::isatty(::fileno(out)) == 1} {
    // A program that reads us sees every line when it is said.
    if (!terminal_) std::setvbuf(out_, nullptr, _IOLBF, 1U << 16U);
}

Console::~Console() {
    if (!bar_.empty()) put("\n");
    file_.reset();  // it may still say something on output
    output_.reset();
    std::fflush(out_);
}

void Console::detach(const std::string& log) {
    if (!log.empty())
        file_ = std::make_unique<BackgroundWriter>(openLog(log), [this, log](const auto& why) {
            const std::lock_guard lock{mutex_};
            put(fmt::format("warning: {}: cannot be written: {}; the run goes on\n", log, why));
        });
    std::fflush(out_);
    output_ = std::make_unique<BackgroundWriter>(
        ::fcntl(::fileno(out_), F_DUPFD_CLOEXEC, 0), [](const std::string& why) {
            std::fputs(("gnomon: standard output cannot be written: " + why + "; the run goes on\n")
                           .c_str(),
                       stderr);
        });
}

void Console::put(const std::string& text) {
    if (output_)
        output_->write(text);
    else
        std::fputs(text.c_str(), out_);
}

void Console::keep(const std::string& text) {
    if (file_) file_->write(timeNow() + " " + text + "\n");
}

void Console::line(const std::string& text) {
    const std::lock_guard lock{mutex_};
    keep(text);
    clearBar();
    put(text + "\n");
    drawBar();
}

void Console::log(LogLevel level, const std::string& text) {
    if (level == LogLevel::debug) return;
    const char* word = level == LogLevel::warning ? "warning: "
                       : level == LogLevel::error ? "error: "
                                                  : "";
    line(word + text);
}

void Console::progress(const std::string& title, double share, const std::string& what) {
    const std::lock_guard lock{mutex_};
    share = std::clamp(share, 0.0, 1.0);
    if (!terminal_) {
        plainProgress(title, share, what);
        return;
    }
    constexpr int cells = 30;
    const int full = static_cast<int>(std::lround(share * cells));
    clearBar();
    if (share < 1.0) {
        bar_ = fmt::format("{} [{:#<{}}{: <{}}] {:3.0f} % {}", title, "", full, "", cells - full,
                           share * 100.0, what)
                   .substr(0, terminalWidth(out_) - 1);
    } else {
        bar_.clear();
        put(fmt::format("{}: {}\n", title, what.empty() ? "done" : what));
    }
    drawBar();
}

void Console::plainProgress(const std::string& title, double share, const std::string& what) {
    const int quarter = static_cast<int>(share * 4.0);
    if (title == lastPlain_ && quarter == lastQuarter_) return;
    const bool finished = share >= 1.0;
    lastPlain_ = finished ? std::string{} : title;
    lastQuarter_ = finished ? -1 : quarter;
    put(fmt::format("{}: {:.0f} %{}{}\n", title, share * 100.0, what.empty() ? "" : " ", what));
}

void Console::clearBar() {
    if (!bar_.empty()) put("\r\x1b[K");
}

void Console::drawBar() {
    if (!bar_.empty()) put(bar_);
    if (!output_) std::fflush(out_);
}

}  // namespace gnomon::client
