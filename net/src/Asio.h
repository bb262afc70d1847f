#pragma once

// The only door to Asio; private to net, so that nobody else pays for it. <utility> comes first
// because Asio 1.18's headers use std::exchange without it.
#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/multicast.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cstdint>
#include <utility>

namespace gnomon::net {

namespace asio = boost::asio;
using boost::asio::ip::tcp;
using boost::asio::ip::udp;
using boost::system::error_code;

using SteadyClock = std::chrono::steady_clock;
using TimePoint = SteadyClock::time_point;
using Milliseconds = std::chrono::milliseconds;

/// Nanoseconds of this machine's steady clock, as Ping, Pong and Ready carry them.
inline std::int64_t steadyNanoseconds(TimePoint when = SteadyClock::now()) noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(when.time_since_epoch()).count();
}

inline double millisecondsOf(SteadyClock::duration span) noexcept {
    return std::chrono::duration<double, std::milli>(span).count();
}

/// This machine alone reaches it; also as an IPv4 address in IPv6's clothes.
inline bool isLoopback(const asio::ip::address& address) {
    if (address.is_v6() && address.to_v6().is_v4_mapped())
        return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).is_loopback();
    return address.is_loopback();
}

/// "127.0.0.1:4711", or "(closed)".
std::string nameOf(const tcp::socket& socket);

}  // namespace gnomon::net
