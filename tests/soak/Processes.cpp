#include "Processes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace gnomon::soak {
namespace {

namespace fs = std::filesystem;

struct Stat {
    char state = ' ';
    pid_t parent = 0;
};

/// State and parent follow the program's name, which may hold anything but ends with the last ')'.
Stat statOf(const fs::path& folder) {
    std::ifstream in{folder / "stat"};
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    Stat stat;
    if (const auto end = text.rfind(')'); end != std::string::npos)
        std::istringstream{text.substr(end + 1)} >> stat.state >> stat.parent;
    return stat;
}

/// Calls fn(pid, stat) for every child of ours.
template <class Fn>
void forEachChild(Fn&& fn) {
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator{"/proc", ec}) {
        const auto name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const Stat stat = statOf(entry.path());
        if (stat.parent == ::getpid()) fn(static_cast<pid_t>(std::stol(name)), stat);
    }
}

}  // namespace

long residentKib(pid_t pid) {
    std::ifstream in{fmt::format("/proc/{}/statm", pid)};
    long size = 0;
    long resident = 0;
    in >> size >> resident;
    return resident * (::sysconf(_SC_PAGESIZE) / 1024);
}

int openFiles(pid_t pid) {
    std::error_code ec;
    int count = 0;
    for (auto at = fs::directory_iterator{fmt::format("/proc/{}/fd", pid), ec};
         !ec && at != fs::directory_iterator{}; at.increment(ec))
        ++count;
    // Listing our own takes one itself.
    return pid == ::getpid() && count > 0 ? count - 1 : count;
}

int zombies() {
    int count = 0;
    forEachChild([&](pid_t, const Stat& stat) { count += stat.state == 'Z' ? 1 : 0; });
    return count;
}

std::vector<pid_t> children() {
    std::vector<pid_t> all;
    forEachChild([&](pid_t pid, const Stat&) { all.push_back(pid); });
    return all;
}

}  // namespace gnomon::soak
