#include "Announcers.h"

#include <arpa/inet.h>
#include <gnomon/base/Error.h>
#include <gnomon/net/Lookup.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace gnomon::net::test {
namespace {

sockaddr_in parsed(const std::string& group) {
    const auto found = orThrow(parseLookupGroup(group));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(found.port);
    ::inet_pton(AF_INET, found.address.c_str(), &address.sin_addr);
    return address;
}

int udpSocket() { return ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0); }

in_addr loopback() { return {htonl(INADDR_LOOPBACK)}; }

const sockaddr* plain(const sockaddr_in& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

bool sendsOnLoopback(int fd) {
    const in_addr device = loopback();
    return ::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &device, sizeof device) == 0;
}

int hearing(const sockaddr_in& group) {
    const int fd = udpSocket();
    const int on = 1;
    ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const ip_mreq membership{group.sin_addr, loopback()};
    if (::bind(fd, plain(group), sizeof group) == 0 &&
        ::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0)
        return fd;
    ::close(fd);
    return -1;
}

}  // namespace

std::string lookupGroup() {
    const int fd = udpSocket();
    sockaddr_in address{};
    address.sin_family = AF_INET;
    socklen_t length = sizeof address;
    ::bind(fd, plain(address), sizeof address);
    ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length);
    ::close(fd);
    return "239.255.74.31:" + std::to_string(ntohs(address.sin_port));
}

std::string whyNoMulticast() {
    const auto group = parsed(lookupGroup());
    const int ear = hearing(group);
    if (ear < 0)
        return std::string{"no multicast group can be joined on loopback: "} + std::strerror(errno);
    const int mouth = udpSocket();
    const bool sent =
        sendsOnLoopback(mouth) && ::sendto(mouth, "?", 1, 0, plain(group), sizeof group) == 1;
    pollfd entry{ear, POLLIN, 0};
    const bool came = sent && ::poll(&entry, 1, 5000) > 0;
    ::close(ear);
    ::close(mouth);
    return came ? std::string{} : "no multicast goes over loopback here";
}

FakeAnnouncer::FakeAnnouncer(const std::string& group, Answer answer)
    : fd_{hearing(parsed(group))},
      stop_{::eventfd(0, EFD_CLOEXEC)},
      answer_{std::move(answer)},
      thread_{[this] { run(); }} {}

FakeAnnouncer::~FakeAnnouncer() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(stop_, &one, sizeof one);
    thread_.join();
    ::close(fd_);
    ::close(stop_);
}

void FakeAnnouncer::run() {
    std::array<std::byte, 2048> buffer{};
    for (;;) {
        std::array<pollfd, 2> entries{{{fd_, POLLIN, 0}, {stop_, POLLIN, 0}}};
        ::poll(entries.data(), entries.size(), -1);
        if (entries[1].revents != 0) return;
        sockaddr_in from{};
        socklen_t length = sizeof from;
        const auto got = ::recvfrom(fd_, buffer.data(), buffer.size(), 0,
                                    reinterpret_cast<sockaddr*>(&from), &length);
        if (got < 0) return;
        ++heard_;
        const auto said = answer_(std::span{buffer}.first(static_cast<std::size_t>(got)));
        if (!said.empty()) ::sendto(fd_, said.data(), said.size(), 0, plain(from), length);
    }
}

std::vector<std::vector<std::byte>> ask(const std::string& group,
                                        const std::vector<std::vector<std::byte>>& datagrams,
                                        std::size_t answers) {
    const auto to = parsed(group);
    const int fd = udpSocket();
    sendsOnLoopback(fd);
    for (const auto& datagram : datagrams)
        ::sendto(fd, datagram.data(), datagram.size(), 0, plain(to), sizeof to);
    std::vector<std::vector<std::byte>> came;
    std::array<std::byte, 2048> buffer{};
    pollfd entry{fd, POLLIN, 0};
    while (came.size() < answers && ::poll(&entry, 1, 30000) > 0) {
        const auto got = ::recv(fd, buffer.data(), buffer.size(), 0);
        if (got > 0) came.emplace_back(buffer.begin(), buffer.begin() + got);
    }
    ::close(fd);
    return came;
}

}  // namespace gnomon::net::test
