#include "Datagrams.h"

#include <fmt/format.h>

#include <array>

namespace gnomon::net {

Result<std::span<const std::byte>> datagramBody(Route route, MessageType type,
                                                std::span<const std::byte> datagram) {
    field::Reader from{datagram};
    const auto length = from.scalar<std::uint32_t>();
    const auto found = from.scalar<std::uint32_t>();
    if (from.failed())
        return fail(Errc::protocol,
                    fmt::format("{} bytes, no message is so short", datagram.size()));
    const Limit limit = limitOf(route, found);
    if (!limit.allowed || found != static_cast<std::uint32_t>(type))
        return fail(Errc::protocol, fmt::format("message type {}, expected {} ({})", found,
                                                static_cast<std::uint32_t>(type), name(type)));
    if (length != from.remaining() || length > limit.bytes)
        return fail(Errc::protocol,
                    fmt::format("message {} of {} bytes in a datagram that has {}, at most {}",
                                name(type), length, from.remaining(), limit.bytes));
    return datagram.subspan(from.at());
}

struct Datagrams::State : std::enable_shared_from_this<State> {
    State(asio::io_context& io, udp::socket from, Take to)
        : socket{std::move(from)}, take{std::move(to)}, timer{io} {}

    void receive() {
        if (!allowance.take(SteadyClock::now())) return later(allowance.next());
        socket.async_receive_from(
            asio::buffer(buffer), sender,
            [self = shared_from_this()](error_code ec, std::size_t n) {
                if (!self->take) return;
                // Nothing that is sent makes receiving fail; the system may be short of memory.
                if (ec) return self->later(SteadyClock::now() + Milliseconds{100});
                const auto call = self->take;  // which it may end
                call(std::span{self->buffer}.first(n), self->sender);
                if (self->take) self->receive();
            });
    }
    void later(TimePoint when) {
        timer.at(when, [this] { receive(); });
    }

    udp::socket socket;
    Take take;
    Timer timer;
    Allowance allowance{mostPerSecond};
    udp::endpoint sender = {};
    // More than any of ours: what fills it was cut, and is refused for its length.
    std::array<std::byte, 2 * maxDatagram> buffer = {};
};

Datagrams::Datagrams(asio::io_context& io, udp::socket socket, Take take)
    : state_{std::make_shared<State>(io, std::move(socket), std::move(take))} {
    state_->receive();
}

Datagrams::~Datagrams() {
    state_->take = {};
    state_->timer.cancel();
    error_code ignored;
    state_->socket.close(ignored);
}

udp::socket& Datagrams::socket() noexcept { return state_->socket; }

}  // namespace gnomon::net
