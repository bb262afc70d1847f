#pragma once

#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerMessages.h>

#include <tuple>

namespace gnomon::fuzz {

/// Every message, in the order by which fuzz-wire numbers them.
using Messages =
    std::tuple<net::wire::ClientHello, net::wire::Frame, net::wire::Fit, net::wire::Swap,
               net::wire::Ping, net::wire::Bye, net::wire::Payload, net::wire::Snapshot,
               net::wire::ServerHello, net::wire::Refused, net::wire::Depth, net::wire::Ready,
               net::wire::Digest, net::wire::Event, net::wire::Pong, net::wire::Log,
               net::wire::Image, net::wire::Relay, net::wire::RelayEnd, net::wire::RelayLost,
               net::wire::Digests, net::wire::Lookup, net::wire::Announcement, net::wire::Packed>;
inline constexpr std::size_t messageCount = std::tuple_size_v<Messages>;
/// The numbers behind them.
inline constexpr std::size_t schemaNumber = messageCount;
inline constexpr std::size_t keyFileNumber = messageCount + 1;

}  // namespace gnomon::fuzz
