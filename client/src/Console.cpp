#include "Console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace gnomon::client {
namespace {

std::size_t terminalWidth(std::FILE* out) {
    winsize size{};
    return ::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

Console::Console(std::FILE* out) : out_{out}, terminal_{::isatty(::fileno(out)) == 1} {
    // A program that reads us sees every line when it is said.
    if (!terminal_) std::setvbuf(out_, nullptr, _IOLBF, 1U << 16U);
}

Console::~Console() {
    if (!bar_.empty()) std::fputc('\n', out_);
    std::fflush(out_);
}

void Console::line(const std::string& text) {
    const std::lock_guard lock{mutex_};
    clearBar();
    std::fputs((text + "\n").c_str(), out_);
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
        std::fputs(fmt::format("{}: {}\n", title, what.empty() ? "done" : what).c_str(), out_);
    }
    drawBar();
}

void Console::plainProgress(const std::string& title, double share, const std::string& what) {
    const int quarter = static_cast<int>(share * 4.0);
    if (title == lastPlain_ && quarter == lastQuarter_) return;
    const bool finished = share >= 1.0;
    lastPlain_ = finished ? std::string{} : title;
    lastQuarter_ = finished ? -1 : quarter;
    std::fputs(
        fmt::format("{}: {:.0f} %{}{}\n", title, share * 100.0, what.empty() ? "" : " ", what)
            .c_str(),
        out_);
}

void Console::clearBar() {
    if (!bar_.empty()) std::fputs("\r\x1b[K", out_);
}

void Console::drawBar() {
    if (!bar_.empty()) std::fputs(bar_.c_str(), out_);
    std::fflush(out_);
}

}  // namespace gnomon::client
