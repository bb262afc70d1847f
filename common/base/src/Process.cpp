#include <fcntl.h>
#include <gnomon/base/Process.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

namespace gnomon {
namespace {

void closeFd(int& fd) noexcept {
    if (fd >= 0) ::close(std::exchange(fd, -1));
}

std::error_code lastError() { return {errno, std::generic_category()}; }

/// A library's descriptors (Asio's sockets among them) would stay open in the program, and with
/// them connections that we closed. Ours that are to stay have been put in their places.
void keepFilesFrom(int first) noexcept {
    if (::close_range(static_cast<unsigned>(first), ~0U, CLOSE_RANGE_CLOEXEC) == 0) return;
    const auto most = static_cast<int>(::sysconf(_SC_OPEN_MAX));  // before Linux 5.11
    for (int fd = first; fd < most; ++fd) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
}

/// What runs in the child between fork and exec: async-signal-safe calls only.
[[noreturn]] void becomeProgram(const ChildOptions& options, const char* program,
                                char* const* arguments, char* const* environment, int in, int out,
                                int err, int report, pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::signal(SIGPIPE, SIG_DFL);               // what we ignore the program would ignore, too
    if (::getppid() != parent) ::_exit(127);  // the parent died before prctl took hold
    ::dup2(out, STDOUT_FILENO);
    if (err >= 0) ::dup2(err, STDERR_FILENO);
    if (in < 0) in = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (in >= 0) ::dup2(in, STDIN_FILENO);
    if (options.memoryLimit) {
        const rlimit limit{*options.memoryLimit, *options.memoryLimit};
        ::setrlimit(RLIMIT_AS, &limit);
    }
    if (options.cpuLimit) {
        const auto seconds = static_cast<rlim_t>(options.cpuLimit->count());
        const rlimit limit{seconds, seconds + 1};
        ::setrlimit(RLIMIT_CPU, &limit);
    }
    keepFilesFrom(STDERR_FILENO + 1);
    ::execve(program, arguments, environment);
    const int code = errno;
    [[maybe_unused]] const auto written = ::write(report, &code, sizeof code);
    ::_exit(127);
}

/// Where a program lies that is only named: in a folder of PATH, never in the current one. Empty
/// where it is not found.
std::string found(const std::string& program) {
    if (program.find('/') != std::string::npos) return program;
    const char* path = std::getenv("PATH");
    std::istringstream folders{path == nullptr ? "" : path};
    for (std::string folder; std::getline(folders, folder, ':');) {
        auto candidate = folder + "/" + program;
        if (!folder.empty() && ::access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    return {};
}

}  // namespace

std::filesystem::path programFolder() {
    std::error_code ec;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", ec);
    return ec ? std::filesystem::current_path() : self.parent_path();
}

Result<Child> Child::start(const ChildOptions& options) {
    GNOMON_EXPECTS(!options.arguments.empty(), "a program needs a name");
    const std::string program = found(options.arguments[0]);
    if (program.empty())
        return fail(Errc::process, "cannot start " + options.arguments[0] + ": not found in PATH");
    std::array<int, 2> out{-1, -1};
    std::array<int, 2> err{-1, -1};
    std::array<int, 2> in{-1, -1};  // ours, the child's
    std::array<int, 2> report{-1, -1};
    const auto closeAll = [&] {
        for (auto* pipe : {&out, &err, &report, &in})
            for (int& fd : *pipe) closeFd(fd);
    };
    if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(report.data(), O_CLOEXEC) != 0 ||
        (!options.keepStderr && ::pipe2(err.data(), O_CLOEXEC) != 0) ||
        (options.takesInput &&
         ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0)) {
        const auto cause = lastError();
        closeAll();
        return fail(Errc::process, "cannot make a pipe for " + options.arguments[0], cause);
    }

    // Built before fork: nothing may allocate in the child of a threaded program.
    std::vector<char*> arguments;
    for (const auto& argument : options.arguments)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    std::vector<char*> environment;
    for (char** entry = ::environ; *entry != nullptr; ++entry) {
        const char* equals = std::strchr(*entry, '=');
        const auto length = equals == nullptr ? 0 : static_cast<std::size_t>(equals - *entry) + 1;
        bool replaced = false;
        for (const auto& ours : options.environment)
            replaced = replaced || (length > 0 && ours.compare(0, length, *entry, length) == 0);
        if (!replaced) environment.push_back(*entry);
    }
    for (const auto& ours : options.environment)
        environment.push_back(const_cast<char*>(ours.c_str()));
    environment.push_back(nullptr);

    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0)
        becomeProgram(options, program.c_str(), arguments.data(), environment.data(), in[1], out[1],
                      err[1], report[1], parent);
    const auto forkError = lastError();
    for (int* fd : {&in[1], &out[1], &err[1], &report[1]}) closeFd(*fd);
    if (pid < 0) {
        closeAll();
        return fail(Errc::process, "cannot fork for " + options.arguments[0], forkError);
    }
    int code = 0;
    const auto got = ::read(report[0], &code, sizeof code);
    closeFd(report[0]);
    Child child;
    child.pid_ = pid;
    child.out_ = out[0];
    child.err_ = err[0];
    child.in_ = in[0];
    if (got == sizeof code)
        return fail(Errc::process, "cannot start " + options.arguments[0],
                    {code, std::generic_category()});
    return child;
}

Child::Child(Child&& other) noexcept
    : pid_{std::exchange(other.pid_, -1)},
      out_{std::exchange(other.out_, -1)},
      err_{std::exchange(other.err_, -1)},
      in_{std::exchange(other.in_, -1)},
      status_{other.status_} {}

Child& Child::operator=(Child&& other) noexcept {
    if (this != &other) {
        end();
        pid_ = std::exchange(other.pid_, -1);
        out_ = std::exchange(other.out_, -1);
        err_ = std::exchange(other.err_, -1);
        in_ = std::exchange(other.in_, -1);
        status_ = other.status_;
    }
    return *this;
}

Child::~Child() { end(); }

void Child::end() noexcept {
    if (pid_ > 0 && !ended()) {
        signal(SIGKILL);
        int status = 0;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    pid_ = -1;
    closeFd(out_);
    closeFd(err_);
    closeFd(in_);
}

void Child::signal(int number) const noexcept {
    if (pid_ > 0 && !status_) ::kill(pid_, number);
}

std::optional<int> Child::ended() noexcept {
    if (status_ || pid_ <= 0) return status_;
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    return status_;
}

int Child::wait(std::chrono::steady_clock::time_point deadline) noexcept {
    // A pidfd becomes readable when the process ends: no polling, no signal handler.
    const int watch = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
    while (!ended()) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) {
            signal(SIGKILL);
            int status = 0;
            while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
            }
            status_ = status;
            break;
        }
        pollfd entry{watch, POLLIN, 0};
        ::poll(&entry, watch >= 0 ? 1 : 0, static_cast<int>(std::min<long>(left.count(), 60000)));
    }
    if (watch >= 0) ::close(watch);
    return *status_;
}

std::string describeStatus(int waitStatus) {
    if (WIFSIGNALED(waitStatus)) {
        const int number = WTERMSIG(waitStatus);
        return "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
    }
    return "exit code " + std::to_string(WEXITSTATUS(waitStatus));
}

}  // namespace gnomon
