#pragma once

#include <gnomon/net/Codec.h>
#include <gnomon/net/MessageType.h>

#include <functional>
#include <memory>
#include <span>

#include "Allowance.h"
#include "Asio.h"
#include "Timer.h"

namespace gnomon::net {

/// A datagram is one message in the form it has on a connection: length, type, body.
Result<std::span<const std::byte>> datagramBody(Route route, MessageType type,
                                                std::span<const std::byte> datagram);

template <class M>
std::vector<std::byte> datagram(const M& message) {
    auto bytes = packet(message);
    if constexpr (hasTail<M>) bytes.insert(bytes.end(), message.tail.begin(), message.tail.end());
    return bytes;
}

template <class M>
Result<M> decodeDatagram(Route route, std::span<const std::byte> datagram) {
    const auto body = datagramBody(route, M::type, datagram);
    if (!body) return tl::unexpected{body.error()};
    return decode<M>(*body);
}

/// Receives datagrams, so many a second at most: what comes faster waits in the system's buffer or
/// is lost there, and costs nobody a frame.
class Datagrams {
public:
    static constexpr unsigned mostPerSecond = 1000;
    /// May destroy the Datagrams.
    using Take =
        std::function<void(std::span<const std::byte> datagram, const udp::endpoint& from)>;

    Datagrams(asio::io_context& io, udp::socket socket, Take take);
    /// Takes no more, and closes the socket.
    ~Datagrams();
    Datagrams(const Datagrams&) = delete;
    Datagrams& operator=(const Datagrams&) = delete;

    udp::socket& socket() noexcept;

private:
    struct State;
    std::shared_ptr<State> state_;  // lives on in the handler of the last operation
};

}  // namespace gnomon::net
