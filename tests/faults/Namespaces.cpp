#include "Namespaces.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gnomon/base/Error.h>
#include <gnomon/base/Process.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>

namespace gnomon::faults {
namespace {

int current() {
    const int fd = ::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    if (fd < 0) throw Failure{Errc::process, "this kernel has no network namespaces"};
    return fd;
}

}  // namespace

Namespace::Namespace() {
    const int before = current();
    const bool made = ::unshare(CLONE_NEWNET) == 0;
    const std::error_code why{errno, std::generic_category()};
    if (made) fd_ = current();
    ::setns(before, CLONE_NEWNET);
    ::close(before);
    if (!made)
        throw Failure{
            Error{.code = Errc::process, .what = "cannot make a network namespace", .cause = why}};
    const Inside inside{*this};
    command({"ip", "link", "set", "lo", "up"});
}

Namespace::~Namespace() { ::close(fd_); }

std::string Namespace::path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), fd_); }

Inside::Inside(const Namespace& where) : before_{current()} {
    if (::setns(where.fd(), CLONE_NEWNET) != 0)
        throw Failure{Errc::process, "cannot enter a network namespace"};
}

Inside::~Inside() {
    ::setns(before_, CLONE_NEWNET);
    ::close(before_);
}

void command(std::vector<std::string> words) {
    auto child = orThrow(Child::start({.arguments = words}));
    const int status = child.wait(std::chrono::steady_clock::now() + std::chrono::seconds{30});
    if (status == 0) return;
    std::array<char, 500> said{};
    const auto length = ::read(child.errors(), said.data(), said.size());
    std::string line;
    for (const auto& word : words) line += word + " ";
    throw Failure{Errc::process, fmt::format("{}: {}: {}", line, describeStatus(status),
                                             std::string(said.data(), length > 0 ? length : 0))};
}

std::string whyNoNamespaces() {
    try {
        const Namespace trial;
    } catch (const Failure& failure) {
        return failure.what();
    }
    if (::access("/dev/net/tun", R_OK | W_OK) != 0) return "no /dev/net/tun that may be used";
    return {};
}

}  // namespace gnomon::faults
