#pragma once

#include <gnomon/field/Payload.h>
#include <gnomon/field/Type.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gnomon::importer {

/// What gnomon-import writes, little-endian:
///   header   u32 magic "GNIM", u32 version, 16 bytes digest of the container types,
///            u64 bytes of the change list, u64 bytes of all payloads, u64 number of payloads
///   the change list
///   payloads each 16 bytes hash, u64 size, the bytes
///   end      u32 magic "MING": nothing was cut off
/// On refusal it writes nothing.
struct StreamHeader {
    static constexpr std::uint32_t magic = 0x4d494e47;     // "GNIM"
    static constexpr std::uint32_t endMagic = 0x474e494d;  // "MING"
    static constexpr std::uint32_t version = 1;
    static constexpr std::size_t bytes = 48;

    field::Hash128 types = {};
    std::uint64_t listBytes = 0;
    std::uint64_t payloadBytes = 0;
    std::uint64_t payloads = 0;
};

inline constexpr std::size_t payloadHeadBytes = 24;

std::array<std::byte, StreamHeader::bytes> encoded(const StreamHeader& header);
/// Nothing where magic or version are not ours.
std::optional<StreamHeader> decodedHeader(std::span<const std::byte, StreamHeader::bytes> bytes);

/// Names all container types and their fields: importer and client must be of one build.
field::Hash128 typesDigest(const field::TypeRegistry& types);

/// Progress on the importer's standard error, with --progress: this, the share, a space, the text.
inline constexpr std::string_view progressMark = "@progress ";

}  // namespace gnomon::importer
