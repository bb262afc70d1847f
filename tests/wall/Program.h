#pragma once

#include <gnomon/base/Process.h>
#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::wall {

using namespace std::chrono_literals;

/// Longer than anything here takes on a busy machine; nothing waits for it that goes well.
inline constexpr auto patience = 60s;

/// `gnomon`, another of our programs, or one with its full path: a process whose lines we read.
class Program {
public:
    explicit Program(std::vector<std::string> arguments, std::vector<std::string> environment = {},
                     const std::string& name = "gnomon");
    /// Ends it, if it has not ended.
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// Waits for a line of standard output that contains @p part; false when the program ended
    /// without one. Each line is found once.
    bool says(const std::string& part);
    void signal(int number) const { child_.signal(number); }
    /// Waits for its end: the exit code, or 128 + the signal that ended it.
    int wait();
    pid_t pid() const { return child_.pid(); }

    std::string output();
    std::vector<std::string> errors();

private:
    void read(int fd, std::vector<std::string>& lines);

    Child child_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> output_;  // guarded
    std::vector<std::string> errors_;  // guarded
    std::size_t seen_ = 0;             // lines of output_ that says() has passed
    int open_ = 2;                     // pipes; guarded
    std::optional<int> status_;
    std::thread outputReader_;
    std::thread errorReader_;
};

/// Processes of gnomon-server with this name, anywhere on the machine.
std::vector<pid_t> serversNamed(const std::string& name);
/// Waits until none of them is left; false at the deadline.
bool noneLeft(const std::vector<std::string>& names);

/// A file in a folder of the test's own, which goes with it.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string write(const std::string& name, const std::string& text) const;
    std::string path(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

}  // namespace gnomon::wall
