#include "Relay.h"

#include <gnomon/base/Error.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace gnomon::fuzz {
namespace {

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

void check(bool done) {
    if (!done)
        throw Failure{{.code = Errc::process,
                       .what = "the relay between client and server",
                       .cause = {errno, std::generic_category()}}};
}

}  // namespace

Relay::Relay(std::uint16_t server)
    : server_{server},
      listener_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)},
      stop_{::eventfd(0, EFD_CLOEXEC)} {
    auto address = loopback(0);
    socklen_t length = sizeof address;
    check(::bind(listener_, reinterpret_cast<sockaddr*>(&address), length) == 0);
    check(::listen(listener_, 8) == 0);
    check(::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length) == 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread{[this] { run(); }};
}

Relay::~Relay() {
    end();
    for (const Link& link : links_)
        for (const int socket : {link.client, link.server})
            if (socket >= 0) ::close(socket);
    ::close(listener_);
    ::close(stop_);
}

std::vector<Relay::Piece> Relay::end() {
    if (thread_.joinable()) {
        const std::uint64_t one = 1;
        check(::write(stop_, &one, sizeof one) == sizeof one);
        thread_.join();
    }
    return std::move(pieces_);
}

void Relay::run() {
    while (true) {
        std::vector<pollfd> waits{{stop_, POLLIN, 0}, {listener_, POLLIN, 0}};
        for (const Link& link : links_) {
            waits.push_back({link.client, POLLIN, 0});
            waits.push_back({link.server, POLLIN, 0});
        }
        if (::poll(waits.data(), waits.size(), -1) < 0 || waits[0].revents != 0) return;
        for (std::size_t i = 0; i < links_.size(); ++i) {
            if (waits[2 + 2 * i].revents != 0) pass(i, true);
            if (waits[3 + 2 * i].revents != 0) pass(i, false);
        }
        if (waits[1].revents == 0) continue;
        Link link{.client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC),
                  .server = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
        const auto address = loopback(server_);
        if (::connect(link.server, reinterpret_cast<const sockaddr*>(&address), sizeof address) !=
            0) {
            ::close(link.server);
            ::close(link.client);
            continue;
        }
        links_.push_back(link);
    }
}

void Relay::pass(std::size_t connection, bool toServer) {
    Link& link = links_[connection];
    const int from = toServer ? link.client : link.server;
    const int to = toServer ? link.server : link.client;
    std::array<std::byte, 65536> bytes;
    const auto count = ::recv(from, bytes.data(), bytes.size(), 0);
    if (count > 0) {
        const auto size = static_cast<std::size_t>(count);
        pieces_.push_back({connection, toServer, {bytes.begin(), bytes.begin() + count}});
        for (std::size_t sent = 0; sent < size;) {
            const auto now = ::send(to, bytes.data() + sent, size - sent, MSG_NOSIGNAL);
            if (now <= 0) break;
            sent += static_cast<std::size_t>(now);
        }
        return;
    }
    ::close(std::exchange(link.client, -1));
    ::close(std::exchange(link.server, -1));
}

}  // namespace gnomon::fuzz
