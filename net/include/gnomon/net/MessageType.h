#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon::net {

/// The second u32 of every message. Never reused for another meaning.
enum class MessageType : std::uint32_t {
    clientHello = 1,
    frame = 2,
    fit = 3,
    swap = 4,
    ping = 5,
    bye = 6,
    relay = 7,
    relayEnd = 8,
    payload = 16,
    snapshot = 17,
    packed = 18,
    lookup = 32,
    serverHello = 64,
    refused = 65,
    depth = 66,
    ready = 67,
    digest = 68,
    event = 69,
    pong = 70,
    log = 71,
    relayLost = 72,
    digests = 73,
    image = 80,
    announcement = 96,
};

/// What a connection may carry towards its reader.
enum class Route : std::uint8_t {
    toServerGreeting,
    toServerControl,
    toServerBulk,
    toServerRelay,  // from another server
    toRelay,        // back to that one
    toClientControl,
    toClientBulk,
    toServerLookup,  // by UDP, to a group
    toClientLookup,  // by UDP
};

/// Whether payloads and snapshots are compressed on their way.
enum class Compress : std::uint8_t {
    automatic,  ///< where a connection is slower than the compression
    never,
    always,
    last = always,
};

/// Most bytes a chunk of a payload, snapshot or image carries.
inline constexpr std::size_t chunkBytes = std::size_t{512} << 10U;
/// Most bytes a change list of one frame may take.
inline constexpr std::size_t maxChangeBytes = std::size_t{256} << 20U;
/// Most bytes of one snapshot, of one payload, and of one image.
inline constexpr std::uint64_t maxSnapshotBytes = std::uint64_t{1} << 30U;
inline constexpr std::uint64_t maxPayloadBytes = std::uint64_t{4} << 30U;
/// Most containers whose digests one message tells.
inline constexpr std::size_t maxDigests = std::size_t{1} << 20U;
inline constexpr std::uint64_t maxImageBytes = std::uint64_t{512} << 20U;

/// Most bytes of a datagram, length and type included; so long is every lookup.
inline constexpr std::size_t maxDatagram = 128;
/// Longest name of a server that can be asked for, bytes.
inline constexpr std::size_t maxLookupName = 64;

/// Greatest allowed body, in bytes; nothing where the message may not come on this route.
struct Limit {
    bool allowed = false;
    std::size_t bytes = 0;
};
Limit limitOf(Route route, std::uint32_t type) noexcept;

std::string_view name(MessageType type) noexcept;

}  // namespace gnomon::net
