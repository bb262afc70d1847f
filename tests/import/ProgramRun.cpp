#include "ProgramRun.h"

#include <fcntl.h>
#include <gnomon/base/Process.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>

namespace gnomon::importer {

ProgramRun runImporter(std::vector<std::string> arguments) {
    const auto start = std::chrono::steady_clock::now();
    arguments.insert(arguments.begin(), GNOMON_BIN_DIR "/gnomon-import");
    // Child has no place for rusage: wait4 here, and a fork of our own.
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0) return {};
    std::vector<char*> raw;
    for (auto& argument : arguments) raw.push_back(argument.data());
    raw.push_back(nullptr);
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::dup2(out[1], STDOUT_FILENO);
        ::dup2(err[1], STDERR_FILENO);
        ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    ::close(out[1]);
    ::close(err[1]);
    ProgramRun run;
    std::array<pollfd, 2> pipes{pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
    std::vector<char> buffer(std::size_t{1} << 16U);
    while (pipes[0].fd >= 0 || pipes[1].fd >= 0) {
        if (::poll(pipes.data(), pipes.size(), 60000) == 0) ::kill(pid, SIGKILL);
        for (auto& pipe : pipes) {
            if (pipe.fd < 0 || pipe.revents == 0) continue;
            const auto count = ::read(pipe.fd, buffer.data(), buffer.size());
            if (count <= 0)
                pipe.fd = -1;
            else if (&pipe == &pipes[0])
                run.outputBytes += static_cast<std::uint64_t>(count);
            else
                run.errors.append(buffer.data(), static_cast<std::size_t>(count));
        }
    }
    ::close(out[0]);
    ::close(err[0]);
    int status = 0;
    rusage usage{};
    ::wait4(pid, &status, 0, &usage);
    if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
    run.peakBytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

}  // namespace gnomon::importer
