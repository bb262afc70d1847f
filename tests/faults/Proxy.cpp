#include "Proxy.h"

#include <arpa/inet.h>
#include <gnomon/base/Error.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gnomon::faults {
namespace {

int tcpSocket() {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (fd < 0) throw Failure{Errc::process, "cannot make a socket"};
    return fd;
}

sockaddr_in local(std::uint32_t address, int port) {
    sockaddr_in made{};
    made.sin_family = AF_INET;
    made.sin_addr.s_addr = htonl(address);
    made.sin_port = htons(static_cast<std::uint16_t>(port));
    return made;
}

}  // namespace

Proxy::Proxy(int to) : to_{to}, listener_{tcpSocket()}, wake_{::eventfd(0, EFD_CLOEXEC)} {
    auto address = local(INADDR_ANY, 0);
    socklen_t length = sizeof address;
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listener_, 8) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length) != 0)
        throw Failure{Errc::process, "the proxy cannot listen"};
    port_ = ntohs(address.sin_port);
    thread_ = std::thread{[this] { run(); }};
}

Proxy::~Proxy() {
    ending_ = true;
    wake();
    thread_.join();
    for (const auto& pair : pairs_)
        for (const int fd : {pair.client, pair.server}) ::close(fd);
    ::close(listener_);
    ::close(wake_);
}

void Proxy::stopReading() {
    stopped_ = true;
    wake();
}

void Proxy::readAgain() {
    stopped_ = false;
    wake();
}

void Proxy::wake() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);
}

void Proxy::run() {
    while (!ending_) {
        std::vector<pollfd> entries{{wake_, POLLIN, 0}, {listener_, POLLIN, 0}};
        for (const auto& pair : pairs_) {
            entries.push_back({stopped_ ? -1 : pair.client, POLLIN, 0});
            entries.push_back({pair.server, POLLIN, 0});
        }
        ::poll(entries.data(), entries.size(), -1);
        std::uint64_t count = 0;
        if (entries[0].revents != 0 && ::read(wake_, &count, sizeof count) < 0) continue;
        std::size_t i = 2;
        for (auto pair = pairs_.begin(); pair != pairs_.end(); i += 2) {
            const bool open = (entries[i].revents == 0 || pass(pair->client, pair->server)) &&
                              (entries[i + 1].revents == 0 || pass(pair->server, pair->client));
            if (open) {
                ++pair;
                continue;
            }
            for (const int fd : {pair->client, pair->server}) ::close(fd);
            pair = pairs_.erase(pair);
        }
        if (entries[1].revents == 0) continue;
        const Pair fresh{.client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC),
                         .server = tcpSocket()};
        const auto address = local(INADDR_LOOPBACK, to_);
        if (::connect(fresh.server, reinterpret_cast<const sockaddr*>(&address), sizeof address) ==
            0) {
            const int yes = 1;
            for (const int fd : {fresh.client, fresh.server})
                ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
            pairs_.push_back(fresh);
        } else {
            for (const int fd : {fresh.client, fresh.server}) ::close(fd);
        }
    }
}

/// False at the end of the stream.
bool Proxy::pass(int from, int to) {
    std::array<char, 65536> buffer{};
    const auto got = ::recv(from, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (got <= 0) return false;
    for (ssize_t sent = 0; sent < got;) {
        const auto more =
            ::send(to, buffer.data() + sent, static_cast<std::size_t>(got - sent), MSG_NOSIGNAL);
        if (more <= 0) return false;
        sent += more;
    }
    return true;
}

}  // namespace gnomon::faults
