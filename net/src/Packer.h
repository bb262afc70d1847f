#pragma once

#include <gnomon/net/MessageType.h>

#include <deque>
#include <optional>

#include "Channel.h"

namespace gnomon::net {

/// Whether it is quicker to compress what a connection is to carry, which carries so many bytes a
/// second, than to send it as it is. Packing goes on beside the sending, so that it only has to be
/// the faster of the two, with some room.
/// @param linkRate, packRate  bytes a second
constexpr bool packingPays(double linkRate, double packRate) noexcept {
    return linkRate * 1.2 < packRate;
}

/// Compresses chunks (LZ4) for connections that are slower than the compression is. Each is
/// compressed once, however many connections take it; what hardly shrinks goes as it is.
class Packer {
public:
    explicit Packer(Compress use) noexcept : use_{use} {}

    /// Queues a chunk behind its head: length, type and fields of a Payload or Snapshot.
    void queue(Channel& channel, std::vector<std::byte> head, const Part& chunk);
    /// Bytes that did not have to be sent.
    std::uint64_t spared() const noexcept { return spared_; }

private:
    struct Packed {
        Part chunk = {};
        Part packed = {};  ///< empty: it hardly shrinks
    };
    /// Of what was packed lately: about as much as connections are apart.
    static constexpr std::size_t kept = 32;

    bool pays(const Channel& channel) const;
    const Packed& pack(const Part& chunk);

    const Compress use_;
    std::deque<Packed> lately_;
    double rate_ = 400e6;  ///< bytes a second that we compress; a guess, then measured
    std::uint64_t spared_ = 0;
};

/// The other side: what a Packed carried, as it was.
class Unpacker {
public:
    struct Unpacked {
        MessageType type = {};
        std::span<const std::byte> body = {};  ///< valid until the next one
    };
    /// @return Errc::protocol where it is not what it says
    Result<Unpacked> unpack(std::span<const std::byte> body);

private:
    std::vector<std::byte> body_;
};

}  // namespace gnomon::net
