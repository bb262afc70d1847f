#pragma once

#include <gnomon/net/Codec.h>
#include <gnomon/net/MessageType.h>

#include <array>
#include <string>
#include <string_view>

/// What a client sends. Layouts with offsets: docs/protocol.md. Little-endian.
namespace gnomon::net::wire {

/// A relay connection comes from another server, which passes payloads on.
enum class Role : std::uint8_t { control, bulk, relay, last = relay };

/// How the client paces the wall; for the server's information.
struct SyncParameters {
    static constexpr std::size_t wireBytes = 14;
    std::uint32_t timeoutMs = 0;
    std::uint32_t startTimeoutMs = 0;
    std::uint8_t pipeline = 1;
    bool waitForLate = false;
    std::uint32_t digestEvery = 0;  ///< frames; 0: never

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.timeoutMs);
        io(self.startTimeoutMs);
        io(self.pipeline);
        io(self.waitForLate);
        io(self.digestEvery);
    }
};

/// First on each connection. Bulk and relay ones repeat the control one's token; their schema is
/// empty.
struct ClientHello {
    static constexpr MessageType type = MessageType::clientHello;
    static constexpr std::string_view name = "Hello (client)";
    static constexpr bool greets = true;
    std::uint32_t magic = protocolMagic;
    std::uint32_t version = protocolVersion;
    Role role = Role::control;
    std::uint64_t token = 0;
    SyncParameters sync = {};
    std::vector<std::byte> schema = {};  ///< TypeRegistry::schema()

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.magic);
        io(self.version);
        io(self.role);
        io(self.token);
        io(self.sync);
        io(self.schema);
    }
};

/// A payload by name. The serial counts uploads within a session: it tells an upload from an
/// earlier one of the same content, so that releases (control) and uploads (bulk) cannot cross.
struct PayloadName {
    static constexpr std::size_t wireBytes = 24;
    field::Hash128 hash = {};
    std::uint64_t size = 0;  ///< bytes

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.hash);
        io(self.size);
    }
};

struct PayloadRelease {
    static constexpr std::size_t wireBytes = 24;
    field::Hash128 hash = {};
    std::uint64_t serial = 0;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.hash);
        io(self.serial);
    }
};

/// One frame. The tail is its change list, without payloads.
struct Frame {
    static constexpr MessageType type = MessageType::frame;
    static constexpr std::string_view name = "Frame";
    static constexpr bool hasTail = true;
    static constexpr std::uint32_t capture = 1;     ///< send Images before Ready
    static constexpr std::uint32_t digest = 2;      ///< send Digest before Ready
    static constexpr std::uint32_t wantsDepth = 4;  ///< send Depth, wait for Fit
    static constexpr std::uint32_t tellsDepth = 8;  ///< send Depth before Ready, do not wait
    static constexpr std::uint32_t digests = 16;    ///< send Digests before Ready
    static constexpr std::uint32_t knownFlags = 31;
    std::uint64_t n = 0;
    double time = 0;  ///< seconds, the application's clock
    std::uint32_t flags = 0;
    std::vector<PayloadName> needed = {};       ///< everything the change list names
    std::vector<PayloadRelease> released = {};  ///< no longer needed once this frame is applied
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.time);
        io(self.flags);
        io(self.needed);
        io(self.released);
    }
    const char* wrong() const { return (flags & ~knownFlags) != 0 ? "unknown flags" : nullptr; }
};

/// The shadow fit of frame n where it needed the depth range. The tail is a change list.
struct Fit {
    static constexpr MessageType type = MessageType::fit;
    static constexpr std::string_view name = "Fit";
    static constexpr bool hasTail = true;
    std::uint64_t n = 0;
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
    }
};

/// Show frame n now.
struct Swap {
    static constexpr MessageType type = MessageType::swap;
    static constexpr std::string_view name = "Swap";
    std::uint64_t n = 0;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
    }
};

struct Ping {
    static constexpr MessageType type = MessageType::ping;
    static constexpr std::string_view name = "Ping";
    std::int64_t sentAt = 0;  ///< nanoseconds, the client's steady clock

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.sentAt);
    }
};

/// Pass payloads on to another server: those listed, and all whose uploads come later. Connect to
/// it as a client does, with the role relay and the token of its session. Its uploads come in the
/// order in which they are here.
struct Relay {
    static constexpr MessageType type = MessageType::relay;
    static constexpr std::string_view name = "Relay";
    std::uint64_t token = 0;  ///< of the other server's session
    std::string host = {};    ///< name or numeric address
    std::uint16_t port = 0;
    std::uint64_t after = 0;                  ///< uploads with a later serial are passed on
    std::vector<std::uint64_t> uploads = {};  ///< serials of those that are passed on besides
    Compress compress = Compress::automatic;  ///< what is passed on

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.token);
        io(self.host);
        io(self.port);
        io(self.after);
        io(self.uploads);
        io(self.compress);
    }
};

/// Pass no more on to the server with this session.
struct RelayEnd {
    static constexpr MessageType type = MessageType::relayEnd;
    static constexpr std::string_view name = "RelayEnd";
    std::uint64_t token = 0;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.token);
    }
};

/// The client ends on purpose.
struct Bye {
    static constexpr MessageType type = MessageType::bye;
    static constexpr std::string_view name = "Bye";

    template <class Self, class Io>
    static void fields(Self&, Io&) {}
};

/// Bulk. A part of one payload; parts of a payload come in order and are not mixed with others.
struct Payload {
    static constexpr MessageType type = MessageType::payload;
    static constexpr std::string_view name = "Payload";
    static constexpr bool hasTail = true;
    field::Hash128 hash = {};
    std::uint64_t serial = 0;
    std::uint64_t total = 0;   ///< bytes of the whole payload
    std::uint64_t offset = 0;  ///< bytes
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.hash);
        io(self.serial);
        io(self.total);
        io(self.offset);
    }
    const char* wrong() const {
        if (total == 0 || total > maxPayloadBytes) return "a payload's size is out of range";
        return tail.empty() || offset > total || tail.size() > total - offset
                   ? "a part that lies outside its payload"
                   : nullptr;
    }
};

/// Bulk, relay. A Payload or Snapshot whose tail is compressed: an LZ4 block.
struct Packed {
    static constexpr MessageType type = MessageType::packed;
    static constexpr std::string_view name = "Packed";
    static constexpr bool hasTail = true;
    std::uint32_t inner = 0;           ///< type of the message
    std::uint32_t size = 0;            ///< bytes of its tail
    std::vector<std::byte> head = {};  ///< its fields
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.inner);
        io(self.size);
        io(self.head);
    }
    const char* wrong() const {
        if (inner != static_cast<std::uint32_t>(MessageType::payload) &&
            inner != static_cast<std::uint32_t>(MessageType::snapshot))
            return "neither a Payload nor a Snapshot is packed";
        if (head.size() > 64) return "the packed message's fields are too long";
        return size == 0 || size > chunkBytes ? "a packed chunk's size is out of range" : nullptr;
    }
};

/// What a Snapshot's parts together are: the payloads it names, then the change list that makes an
/// empty aspect the session as of frame n.
struct SnapshotBody {
    static constexpr std::string_view name = "Snapshot";
    static constexpr bool hasTail = true;
    std::vector<PayloadName> needed = {};
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.needed);
    }
};

/// Bulk. A part of a SnapshotBody.
struct Snapshot {
    static constexpr MessageType type = MessageType::snapshot;
    static constexpr std::string_view name = "Snapshot";
    static constexpr bool hasTail = true;
    std::uint64_t n = 0;
    double time = 0;  ///< seconds, as in Frame
    std::uint64_t total = 0;
    std::uint64_t offset = 0;
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.time);
        io(self.total);
        io(self.offset);
    }
    const char* wrong() const {
        if (total > maxSnapshotBytes) return "a snapshot's size is out of range";
        return offset > total || tail.size() > total - offset || (tail.empty() && total != 0)
                   ? "a part that lies outside its snapshot"
                   : nullptr;
    }
};

/// By UDP, to a group: who has this name? So long that no answer is longer: nobody gets more out of
/// a server than went in. Has this form in every version.
struct Lookup {
    static constexpr MessageType type = MessageType::lookup;
    static constexpr std::string_view name = "Lookup";
    static constexpr bool hasTail = true;
    static constexpr std::size_t bodyBytes = maxDatagram - 8;
    static constexpr std::size_t fixedBytes = 4 + 4 + 8 + 4;
    std::uint32_t magic = protocolMagic;
    std::uint32_t version = protocolVersion;  ///< the client's
    std::uint64_t token = 0;                  ///< comes back with the answer
    std::string server = {};
    std::span<const std::byte> tail = {};  ///< zeros, up to bodyBytes

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.magic);
        io(self.version);
        io(self.token);
        io(self.server);
    }
    const char* wrong() const {
        if (magic != protocolMagic) return "not from a Gnomon program";
        if (server.empty() || server.size() > maxLookupName)
            return "a name of a length out of range";
        if (fixedBytes + server.size() + tail.size() != bodyBytes) return "not as long as all are";
        for (const std::byte byte : tail)
            if (byte != std::byte{0}) return "something behind its name";
        return nullptr;
    }
    /// @pre whom.size() <= maxLookupName
    static Lookup padded(std::uint64_t token, std::string whom) {
        static constexpr std::array<std::byte, bodyBytes> zeros{};
        const std::size_t size = fixedBytes + whom.size();
        return {.token = token,
                .server = std::move(whom),
                .tail = std::span{zeros}.first(bodyBytes - size)};
    }
};

}  // namespace gnomon::net::wire
