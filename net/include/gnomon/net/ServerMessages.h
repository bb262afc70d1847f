#pragma once

#include <gnomon/net/Codec.h>
#include <gnomon/net/MessageType.h>

#include <string>
#include <string_view>

/// What a server sends. Layouts with offsets: docs/protocol.md. Little-endian.
namespace gnomon::net::wire {

/// Answers the control connection's Hello.
struct ServerHello {
    static constexpr MessageType type = MessageType::serverHello;
    static constexpr std::string_view name = "Hello (server)";
    static constexpr bool greets = true;
    std::uint32_t magic = protocolMagic;
    std::uint32_t version = protocolVersion;
    std::string server = {};       ///< its name
    std::string description = {};  ///< renderer, windows: for people
    std::vector<std::byte> schema = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.magic);
        io(self.version);
        io(self.server);
        io(self.description);
        io(self.schema);
    }
};

/// What it takes until the server would not refuse any more.
enum class Cure : std::uint8_t {
    time,     ///< nothing but that: it serves another client, say
    restart,  ///< another program, key or type on either side
    last = restart
};

/// Why the server closes the connection after this. The same in every version.
struct Refused {
    static constexpr MessageType type = MessageType::refused;
    static constexpr std::string_view name = "Refused";
    std::string why = {};
    Cure cure = Cure::time;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.why);
        io(self.cure);
    }
};

/// The range of view-space depth seen in frame n, metres; min > max where nothing is seen.
struct Depth {
    static constexpr MessageType type = MessageType::depth;
    static constexpr std::string_view name = "Depth";
    std::uint64_t n = 0;
    float min = 0;
    float max = 0;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.min);
        io(self.max);
    }
};

/// What rendering one frame took. Times in milliseconds, glFinish included.
struct RenderStats {
    static constexpr std::size_t wireBytes = 80;
    float renderMs = 0;  ///< all of it
    float applyMs = 0;   ///< taking in the change list
    float shadowMs = 0;  ///< shadow map passes
    float colourMs = 0;
    std::uint64_t triangles = 0;
    std::uint32_t drawCalls = 0;
    std::uint32_t pagesDrawn = 0;
    std::uint32_t pagesKept = 0;
    std::uint32_t pagesUnseen = 0;  ///< that this server's view does not look up
    std::uint32_t chunksCulled = 0;
    std::uint32_t lightsUnseen = 0;  ///< that reach nothing it sees
    std::uint32_t degenerate = 0;    ///< fits that fell back
    std::uint64_t mapTexels = 0;
    std::uint64_t mapBytes = 0;
    std::uint64_t gpuBytes = 0;
    std::uint32_t catchUp = 0;  ///< frames applied but not rendered since the last Ready

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.renderMs);
        io(self.applyMs);
        io(self.shadowMs);
        io(self.colourMs);
        io(self.triangles);
        io(self.drawCalls);
        io(self.pagesDrawn);
        io(self.pagesKept);
        io(self.pagesUnseen);
        io(self.chunksCulled);
        io(self.lightsUnseen);
        io(self.degenerate);
        io(self.mapTexels);
        io(self.mapBytes);
        io(self.gpuBytes);
        io(self.catchUp);
    }
};

/// Frame n is rendered and can be shown.
struct Ready {
    static constexpr MessageType type = MessageType::ready;
    static constexpr std::string_view name = "Ready";
    std::uint64_t n = 0;
    std::uint64_t shownFrame = 0;  ///< the frame shown last; 0: none yet
    std::int64_t shownAt = 0;      ///< when it was: nanoseconds, the server's steady clock
    std::uint32_t images = 0;      ///< how many Images of frame n were sent; ServerHost fills it
    RenderStats stats = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.shownFrame);
        io(self.shownAt);
        io(self.images);
        io(self.stats);
    }
};

/// Aspect::digest() after frame n and its Fit.
struct Digest {
    static constexpr MessageType type = MessageType::digest;
    static constexpr std::string_view name = "Digest";
    std::uint64_t n = 0;
    std::uint64_t digest = 0;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.digest);
    }
};

struct OneDigest {
    static constexpr std::size_t wireBytes = 16;
    std::uint64_t id = 0;  ///< field::Id
    std::uint64_t digest = 0;

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.id);
        io(self.digest);
    }
};

/// Aspect::digests() after frame n and its Fit; the first maxDigests of them.
struct Digests {
    static constexpr MessageType type = MessageType::digests;
    static constexpr std::string_view name = "Digests";
    std::uint64_t n = 0;
    std::vector<OneDigest> list = {};  ///< by id

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.list);
    }
};

enum class EventKind : std::uint8_t {
    key,
    character,
    button,
    move,
    scroll,
    resize,
    close,
    last = close
};

/// Input from a server's window. Codes, actions and modifiers are GLFW's numbers.
struct Event {
    static constexpr MessageType type = MessageType::event;
    static constexpr std::string_view name = "Event";
    std::uint64_t window = 0;  ///< field::Id of the window's container
    EventKind kind = EventKind::key;
    std::int32_t code = 0;  ///< key, Unicode point or button
    std::int32_t action = 0;
    std::int32_t mods = 0;
    double x = 0;  ///< pixels from the left; scroll: steps
    double y = 0;  ///< pixels from the top; scroll: steps

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.window);
        io(self.kind);
        io(self.code);
        io(self.action);
        io(self.mods);
        io(self.x);
        io(self.y);
    }
};

/// What the server's main thread is at.
enum class Activity : std::uint8_t { idle, loading, compiling, rendering, last = rendering };

/// Answers Ping from the socket thread, and says how the main thread gets on.
struct Pong {
    static constexpr MessageType type = MessageType::pong;
    static constexpr std::string_view name = "Pong";
    std::int64_t sentAt = 0;         ///< copied from the Ping
    std::int64_t serverClock = 0;    ///< nanoseconds, the server's steady clock
    std::uint64_t lastFinished = 0;  ///< last frame that the main thread made Ready
    std::uint64_t current = 0;       ///< the frame it is at; 0: none
    std::uint32_t busyMs = 0;        ///< for how long
    Activity activity = Activity::idle;
    std::uint64_t arrived = 0;  ///< bytes of payloads and snapshot that have come in this session

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.sentAt);
        io(self.serverClock);
        io(self.lastFinished);
        io(self.current);
        io(self.busyMs);
        io(self.activity);
        io(self.arrived);
    }
};

/// Payloads cannot be passed on any more to the server with this session (see Relay).
struct RelayLost {
    static constexpr MessageType type = MessageType::relayLost;
    static constexpr std::string_view name = "RelayLost";
    std::uint64_t token = 0;
    std::string why = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.token);
        io(self.why);
    }
};

enum class LogLevel : std::uint8_t { debug, info, warning, error, last = error };

struct Log {
    static constexpr MessageType type = MessageType::log;
    static constexpr std::string_view name = "Log";
    LogLevel level = LogLevel::info;
    std::string text = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.level);
        io(self.text);
    }
};

/// Bulk. A part of a captured picture; parts come in order and are not mixed with others.
struct Image {
    static constexpr MessageType type = MessageType::image;
    static constexpr std::string_view name = "Image";
    static constexpr bool hasTail = true;
    std::uint64_t n = 0;
    std::uint64_t window = 0;  ///< field::Id of the window's container
    std::uint32_t x = 0;       ///< where in the window, pixels from the left
    std::uint32_t y = 0;       ///< pixels from the top
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint8_t channels = 0;  ///< 3: RGB, 4: RGBA; 8 bits each, top row first
    std::uint64_t offset = 0;   ///< bytes
    std::span<const std::byte> tail = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.n);
        io(self.window);
        io(self.x);
        io(self.y);
        io(self.width);
        io(self.height);
        io(self.channels);
        io(self.offset);
    }
    std::uint64_t total() const { return std::uint64_t{width} * height * channels; }
    const char* wrong() const {
        if (channels != 3 && channels != 4) return "a picture that is neither RGB nor RGBA";
        if (width == 0 || height == 0 || width > 65536 || height > 65536 || total() > maxImageBytes)
            return "a picture's size is out of range";
        return tail.empty() || offset > total() || tail.size() > total() - offset
                   ? "a part that lies outside its picture"
                   : nullptr;
    }
};

/// By UDP, to who sent a Lookup: where the server is. Its address is the datagram's. Has this form
/// in every version.
struct Announcement {
    static constexpr MessageType type = MessageType::announcement;
    static constexpr std::string_view name = "Announcement";
    std::uint32_t magic = protocolMagic;
    std::uint32_t version = protocolVersion;  ///< the server's
    std::uint64_t token = 0;                  ///< copied from the Lookup
    std::uint64_t instance = 0;               ///< of the process, by chance
    std::uint16_t port = 0;                   ///< TCP
    std::string server = {};

    template <class Self, class Io>
    static void fields(Self& self, Io& io) {
        io(self.magic);
        io(self.version);
        io(self.token);
        io(self.instance);
        io(self.port);
        io(self.server);
    }
    const char* wrong() const {
        if (magic != protocolMagic) return "not from a Gnomon program";
        if (server.empty() || server.size() > maxLookupName)
            return "a name of a length out of range";
        return port == 0 ? "port 0" : nullptr;
    }
};

}  // namespace gnomon::net::wire
