#include <fmt/format.h>
#include <gnomon/net/Codec.h>
#include <gnomon/net/MessageType.h>
#include <gnomon/net/ServerMessages.h>

namespace gnomon::net {
namespace detail {

Result<void> checkPreamble(std::string_view message, std::span<const std::byte> body) {
    field::Reader from{body};
    const auto magic = from.scalar<std::uint32_t>();
    const auto version = from.scalar<std::uint32_t>();
    if (from.failed()) return tl::unexpected{decodeError(message, from, body.size())};
    if (magic != protocolMagic)
        return fail(Errc::protocol, fmt::format("{}: begins with {:#010x}, expected {:#010x} "
                                                "(\"GNOM\"): not a Gnomon program",
                                                message, magic, protocolMagic));
    if (version != protocolVersion)
        return fail(Errc::protocol, fmt::format("{}: protocol version {}, expected {}", message,
                                                version, protocolVersion));
    return {};
}

Error decodeError(std::string_view message, const field::Reader& from, std::size_t bytes) {
    return {.code = Errc::protocol,
            .what = fmt::format("message {}, byte {} of {}: {}", message, from.at(), bytes,
                                from.why())};
}

}  // namespace detail

Limit limitOf(Route route, std::uint32_t type) noexcept {
    constexpr std::size_t kib = 1024;
    constexpr std::size_t mib = 1024 * kib;
    const auto upTo = [](std::size_t bytes) { return Limit{.allowed = true, .bytes = bytes}; };
    const auto message = static_cast<MessageType>(type);
    using enum MessageType;
    switch (route) {
        case Route::toServerGreeting:
            return message == clientHello ? upTo(mib) : Limit{};
        case Route::toServerControl:
            switch (message) {
                case frame:
                    return upTo(maxChangeBytes);
                case fit:
                    return upTo(16 * mib);
                case swap:
                case ping:
                case bye:
                case relayEnd:
                    return upTo(kib);
                case relay:
                    return upTo(16 * mib);
                default:
                    return {};
            }
        case Route::toServerRelay:
            return message == payload || message == packed ? upTo(mib) : Limit{};
        case Route::toRelay:
            return message == refused ? upTo(64 * kib) : Limit{};
        case Route::toServerBulk:
            return message == payload || message == snapshot || message == packed ? upTo(mib)
                                                                                  : Limit{};
        case Route::toClientControl:
            switch (message) {
                case serverHello:
                    return upTo(mib);
                case refused:
                case log:
                case relayLost:
                    return upTo(64 * kib);
                case digests:
                    return upTo(12 + maxDigests * wire::OneDigest::wireBytes);
                case depth:
                case ready:
                case digest:
                case event:
                case pong:
                    return upTo(kib);
                default:
                    return {};
            }
        case Route::toClientBulk:
            if (message == refused) return upTo(64 * kib);
            return message == image ? upTo(mib) : Limit{};
        case Route::toServerLookup:
            return message == lookup ? upTo(maxDatagram - 8) : Limit{};
        case Route::toClientLookup:
            return message == announcement ? upTo(maxDatagram - 8) : Limit{};
    }
    return {};
}

std::string_view name(MessageType type) noexcept {
    switch (type) {
        using enum MessageType;
        case clientHello:
        case serverHello:
            return "Hello";
        case frame:
            return "Frame";
        case fit:
            return "Fit";
        case swap:
            return "Swap";
        case ping:
            return "Ping";
        case bye:
            return "Bye";
        case relay:
            return "Relay";
        case relayEnd:
            return "RelayEnd";
        case payload:
            return "Payload";
        case snapshot:
            return "Snapshot";
        case packed:
            return "Packed";
        case refused:
            return "Refused";
        case depth:
            return "Depth";
        case ready:
            return "Ready";
        case digest:
            return "Digest";
        case digests:
            return "Digests";
        case event:
            return "Event";
        case pong:
            return "Pong";
        case log:
            return "Log";
        case relayLost:
            return "RelayLost";
        case image:
            return "Image";
        case lookup:
            return "Lookup";
        case announcement:
            return "Announcement";
    }
    return "unknown";
}

}  // namespace gnomon::net
