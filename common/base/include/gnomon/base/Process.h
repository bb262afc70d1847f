#pragma once

#include <gnomon/base/Error.h>
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Folder of the running program: where its sister programs lie.
std::filesystem::path programFolder();

/// How a child process starts. It dies with its parent (PR_SET_PDEATHSIG), so none is orphaned.
struct ChildOptions {
    std::vector<std::string> arguments = {};        ///< arguments[0]: path, or a name found in PATH
    std::vector<std::string> environment = {};      ///< `NAME=value`, added to ours
    std::optional<std::uint64_t> memoryLimit = {};  ///< address space, bytes
    std::optional<std::chrono::seconds> cpuLimit = {};
    bool keepStderr = false;  ///< true: stderr is ours; false: it is read from errors()
    /// true: what is written to input() is its standard input, which ends with the Child, or with
    /// us; false: it has none
    bool takesInput = false;
};

/// A started program whose standard output we read. Killed, and waited for, when destroyed.
class Child {
public:
    static Result<Child> start(const ChildOptions& options);
    ~Child();
    Child(Child&& other) noexcept;
    Child& operator=(Child&& other) noexcept;
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    pid_t pid() const noexcept { return pid_; }
    int output() const noexcept { return out_; }  ///< reads its standard output
    int errors() const noexcept { return err_; }  ///< reads its standard error; -1 if kept
    /// Writes its standard input; -1 without takesInput. A child that does not read raises EPIPE,
    /// not SIGPIPE: it is a socket, so use send() with MSG_NOSIGNAL.
    int input() const noexcept { return in_; }
    void signal(int number) const noexcept;
    /// The raw wait status once it ended; nothing while it runs.
    std::optional<int> ended() noexcept;
    /// Waits until it ends; kills it at the deadline. The raw wait status.
    int wait(std::chrono::steady_clock::time_point deadline) noexcept;

private:
    Child() = default;
    void end() noexcept;

    pid_t pid_ = -1;
    int out_ = -1;
    int err_ = -1;
    int in_ = -1;
    std::optional<int> status_ = {};
};

/// "exit code 3", "signal 11 (Segmentation fault)".
std::string describeStatus(int waitStatus);

}  // namespace gnomon
