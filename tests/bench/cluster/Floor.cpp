#include "Floor.h"

#include <arpa/inet.h>
#include <gnomon/base/Error.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>

namespace gnomon::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t frameBytes = 52, readyBytes = 116, mostFrames = 5'000;

void check(bool fine, const char* what) {
    if (!fine)
        throw Failure{{.code = Errc::file,
                       .what = what,
                       .cause = std::error_code{errno, std::system_category()}}};
}

void watch(int epoll, int fd) {
    const int on = 1;
    ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    epoll_event event{.events = EPOLLIN | EPOLLET, .data = {.fd = fd}};
    check(::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event) == 0, "epoll_ctl");
}

/// A server: answers until the connection ends.
[[noreturn]] void echo(const sockaddr_in& to) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0), epoll = ::epoll_create1(0);
    if (::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) ::_exit(1);
    watch(epoll, fd);
    std::array<char, 65536> bytes{};
    epoll_event event{};
    while (::epoll_wait(epoll, &event, 1, -1) == 1 &&
           ::recv(fd, bytes.data(), bytes.size(), MSG_DONTWAIT) > 0)
        if (::send(fd, bytes.data(), readyBytes, MSG_NOSIGNAL) < 0) break;
    ::_exit(0);
}

class Echoes {
public:
    explicit Echoes(int servers) {
        const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in at{.sin_family = AF_INET, .sin_port = 0, .sin_addr = {}, .sin_zero = {}};
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof at;
        check(::bind(listener, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0 &&
                  ::getsockname(listener, reinterpret_cast<sockaddr*>(&at), &size) == 0 &&
                  ::listen(listener, servers) == 0,
              "listen");
        for (int i = 0; i < servers; ++i) {
            const pid_t child = ::fork();
            check(child >= 0, "fork");
            if (child == 0) echo(at);
            children_.push_back(child);
            sockets_.push_back(::accept(listener, nullptr, nullptr));
            check(sockets_.back() >= 0, "accept");
            watch(epoll_, sockets_.back());
        }
        ::close(listener);
    }
    ~Echoes() {
        for (const int fd : sockets_) ::close(fd);
        for (const pid_t child : children_) ::waitpid(child, nullptr, 0);
        ::close(epoll_);
    }
    Echoes(const Echoes&) = delete;
    Echoes& operator=(const Echoes&) = delete;

    void frame() {
        for (const int fd : sockets_)
            check(::send(fd, bytes_.data(), frameBytes, MSG_NOSIGNAL) > 0, "send");
        std::size_t ready = 0;
        while (ready < sockets_.size()) {
            const int count =
                ::epoll_wait(epoll_, events_.data(), static_cast<int>(events_.size()), -1);
            for (int i = 0; i < count; ++i) {
                check(::recv(events_[static_cast<std::size_t>(i)].data.fd, bytes_.data(),
                             bytes_.size(), MSG_DONTWAIT) > 0,
                      "recv");
                ++ready;
            }
        }
    }

private:
    const int epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
    std::vector<pid_t> children_;
    std::vector<int> sockets_;
    std::array<epoll_event, 128> events_{};
    std::array<char, 65536> bytes_{};
};

}  // namespace

std::vector<double> floorOf(int servers, double seconds) {
    Echoes echoes{servers};
    for (int i = 0; i < 20; ++i) echoes.frame();
    std::vector<double> taken;
    const auto end = Clock::now() + std::chrono::duration<double>{seconds};
    auto since = Clock::now();
    while (since < end && taken.size() < mostFrames) {
        echoes.frame();
        const auto now = Clock::now();
        taken.push_back(std::chrono::duration<double, std::micro>(now - since).count());
        since = now;
    }
    return taken;
}

}  // namespace gnomon::bench
