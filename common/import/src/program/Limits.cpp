#include "program/Limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

#include "format/Sanitizer.h"
#include "input/Report.h"

namespace gnomon::importer {
namespace {

// A signal handler has no other way to its data.
std::array<char, 1024> timeoutLine{};
std::size_t timeoutLength = 0;

extern "C" void onAlarm(int) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, timeoutLine.data(), timeoutLength);
    ::_exit(1);
}

}  // namespace

void limitProcess(const std::string& file, std::uint64_t maxMemory, std::uint32_t maxSeconds) {
    const rlimit noCore{0, 0};
    ::setrlimit(RLIMIT_CORE, &noCore);
    if (!reservesAddressSpace) {
        rlimit memory{};
        ::getrlimit(RLIMIT_AS, &memory);
        if (memory.rlim_cur == RLIM_INFINITY || memory.rlim_cur > maxMemory) {
            memory.rlim_cur = maxMemory;
            ::setrlimit(RLIMIT_AS, &memory);
        }
    }
    const auto line = printable(file, 800) + ": the import took longer than " +
                      std::to_string(maxSeconds) + " s and was stopped\n";
    timeoutLength = std::min(line.size(), timeoutLine.size());
    std::memcpy(timeoutLine.data(), line.data(), timeoutLength);
    struct sigaction action {};
    action.sa_handler = &onAlarm;
    ::sigaction(SIGALRM, &action, nullptr);
    ::alarm(maxSeconds);
    ::signal(SIGPIPE, SIG_IGN);  // write() reports it
}

}  // namespace gnomon::importer
