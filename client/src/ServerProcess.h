#pragma once

#include <gnomon/base/Process.h>
#include <gnomon/client/Launcher.h>

#include <chrono>
#include <optional>
#include <string>

namespace gnomon::client {

/// Takes lines out of what a pipe gives, a piece at a time.
class LineReader {
public:
    /// Reads what is there without waiting for more. False at the end of the pipe.
    template <class OnLine>
    bool read(int fd, OnLine&& onLine);

private:
    static constexpr std::size_t longest = 4096;  // bytes; longer lines are cut in pieces
    bool fill(int fd);

    std::string pending_ = {};
};

/// One server process and its past ones. Belongs to the launcher's thread.
class ServerProcess {
public:
    using Clock = std::chrono::steady_clock;

    ServerProcess(LaunchCommand command, const LauncherOptions& options)
        : command_{std::move(command)}, options_{options} {}
    ServerProcess(ServerProcess&&) noexcept;
    ~ServerProcess();

    /// Starts it if it is not running and its time has come. An error if it cannot be started.
    Result<void> startIfDue(Clock::time_point now);
    /// What to wait for: its two pipes and its end (a pidfd); -1 where there is none.
    int output() const noexcept { return child_ && outputOpen_ ? child_->output() : -1; }
    int errors() const noexcept { return child_ && errorsOpen_ ? child_->errors() : -1; }
    int end() const noexcept { return pidfd_; }
    /// When it is to be started; nothing while it runs.
    std::optional<Clock::time_point> due() const noexcept;

    void readOutput();
    void readErrors();
    /// Its wait status if it has ended; reads its last words and plans the next start, which will
    /// be logged with the reason: a Ctrl-C ends servers too, and then no next start comes.
    std::optional<int> reap(Clock::time_point now);

    const LaunchCommand& command() const noexcept { return command_; }
    /// "ended with exit code 1: no display", of the last end.
    const std::string& why() const noexcept { return why_; }
    int pid() const noexcept { return child_ ? static_cast<int>(child_->pid()) : -1; }
    void signal(int number) const noexcept {
        if (child_) child_->signal(number);
    }

private:
    void log(LogLevel level, const std::string& text) const;
    void onOutputLine(const std::string& line);

    LaunchCommand command_;
    const LauncherOptions& options_;
    std::optional<Child> child_ = {};
    int pidfd_ = -1;
    bool outputOpen_ = false;
    bool errorsOpen_ = false;
    bool reported_ = false;  // its port
    LineReader outputLines_ = {};
    LineReader errorLines_ = {};
    std::string lastLine_ = {};  // of its standard error
    std::string why_ = {};
    Clock::time_point startedAt_ = {};
    Clock::time_point due_ = {};
    std::chrono::milliseconds pause_{100};  // before the next start
};

}  // namespace gnomon::client
