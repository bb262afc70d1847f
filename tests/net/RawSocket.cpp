#include "RawSocket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

namespace gnomon::net::test {
namespace {

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

}  // namespace

RawSocket::RawSocket(std::uint16_t port) : fd_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
    const sockaddr_in to = loopback(port);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
        throw std::runtime_error{"cannot connect to the test server"};
}

RawSocket::~RawSocket() {
    if (fd_ >= 0) ::close(fd_);
}

void RawSocket::reset() {
    const linger now{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    ::close(std::exchange(fd_, -1));
}

void RawSocket::send(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return;  // it was thrown out already
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
}

std::vector<std::byte> RawSocket::readAll(bool* closed) {
    std::vector<std::byte> all;
    *closed = false;
    while (true) {
        pollfd wait{.fd = fd_, .events = POLLIN, .revents = 0};
        if (::poll(&wait, 1, 30'000) <= 0) return all;
        std::byte room[4096];
        const auto got = ::recv(fd_, room, sizeof room, 0);
        if (got <= 0) {
            *closed = true;
            return all;
        }
        all.insert(all.end(), room, room + got);
    }
}

std::vector<std::byte> RawSocket::read(std::size_t atLeast) {
    std::vector<std::byte> all;
    while (all.size() < atLeast) {
        pollfd wait{.fd = fd_, .events = POLLIN, .revents = 0};
        if (::poll(&wait, 1, 30'000) <= 0) break;
        std::byte room[4096];
        const auto got = ::recv(fd_, room, sizeof room, 0);
        if (got <= 0) break;
        all.insert(all.end(), room, room + got);
    }
    return all;
}

DeafListener::DeafListener() : fd_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
    sockaddr_in at = loopback(0);
    socklen_t length = sizeof at;
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0 ||
        ::listen(fd_, 8) != 0 || ::getsockname(fd_, reinterpret_cast<sockaddr*>(&at), &length) != 0)
        throw std::runtime_error{"cannot listen"};
    port_ = ntohs(at.sin_port);
}

RawSocket DeafListener::accept() {
    pollfd wait{.fd = fd_, .events = POLLIN, .revents = 0};
    ::poll(&wait, 1, 30'000);
    return RawSocket{RawSocket::Adopt{::accept(fd_, nullptr, nullptr)}};
}

DeafListener::~DeafListener() { ::close(fd_); }

}  // namespace gnomon::net::test
