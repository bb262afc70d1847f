#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/net/MessageType.h>
#include <gnomon/net/ServerEvent.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::net {

struct ServerAddress {
    std::string name = {};  ///< unique on the wall
    std::string host = {};  ///< name or numeric address
    std::uint16_t port = 0;
    /// Where to ask for host and port by the name, see parseLookupGroup(): they are unknown before
    /// that, and again whenever the server was lost. Empty: they are known.
    std::string lookup = {};
};

/// "left (127.0.0.1:4711)", or "left (looked up)" as long as nobody has answered.
std::string labelOf(const ServerAddress& server);

struct SyncOptions {
    /// How long the wall waits for a server after the first one is ready.
    std::chrono::milliseconds timeout{1000};
    /// How long a server may take to load, and everybody together for one frame.
    std::chrono::milliseconds startTimeout{60000};
    /// Never drop a server for being late; only when its connection ends.
    bool waitForLate = false;
    /// How far the application runs ahead: frame(n) returns when n - pipeline is shown. 0 to 2.
    int pipeline = 1;
    /// Compare digests every so many frames; 0: never.
    int digestEvery = 64;
    std::chrono::milliseconds pingInterval{250};
    /// Payloads are sent to so many servers, each of which passes them on to as many, and so on;
    /// 0: we send them to all.
    int relay = 0;
    Compress compress = Compress::automatic;
};

/// Callbacks, one at a time, on the application's thread within its calls or on the hub's own.
/// None may call the hub.
struct HubHooks {
    /// After the application's list of a frame was applied to the session aspect. May create and
    /// edit containers of the session's own space (1); they travel with the same frame.
    std::function<void(field::Aspect& session, const field::Applied& applied, std::uint64_t frame)>
        prepare = {};
    /// After prepare: must the servers report their depth range before the fit is made?
    std::function<bool(const field::Aspect& session, std::uint64_t frame)> wantsDepth = {};
    /// With the merged range, metres of view-space depth (min > max: nothing seen). May edit as
    /// prepare may, but not name payloads.
    std::function<void(field::Aspect& session, std::uint64_t frame, float min, float max)> fit = {};
    /// After prepare: shall the servers tell the depth range of the frame once it is rendered?
    std::function<bool(const field::Aspect& session, std::uint64_t frame)> tellsDepth = {};
    /// The merged range of a frame that was swapped, as in fit; only where all who made it Ready
    /// in time told theirs.
    std::function<void(std::uint64_t frame, float min, float max)> depthSeen = {};
    std::function<void(LogLevel level, const std::string& text)> log = {};
};

/// What handing over frame n brought to light. The figures are those of frame `shown`.
struct FrameResult {
    std::uint64_t n = 0;                ///< the frame handed over
    std::uint64_t shown = 0;            ///< the newest frame that was swapped; 0: none yet
    double ms = 0;                      ///< from its sending to its swap
    std::optional<double> skewMs = {};  ///< between first and last server, of frame shown - 1
    std::string waitedFor = {};         ///< the server that was ready last
    std::vector<std::string> droppedNow = {};  ///< since the call before
    std::vector<std::string> joinedNow = {};   ///< since the call before
    std::uint64_t bytes = 0;         ///< to each server: the newest frame sent and its swap
    std::uint64_t payloadBytes = 0;  ///< to each server: payloads that were new in it
};

struct InputEventFrom {
    std::string server = {};
    InputEvent event = {};
};

struct TileImage {
    std::string server = {};
    Image image = {};
};

enum class ServerState : std::uint8_t {
    waiting,     ///< not connected; tried again after a while
    looking,     ///< its name is asked for by UDP
    connecting,  ///< TCP
    greeting,    ///< Hello sent, not answered yet
    joining,     ///< it loads; the wall does not wait for it
    member,      ///< it takes part
};

struct ServerStatus {
    ServerAddress address = {};
    ServerState state = ServerState::waiting;
    std::string text = {};  ///< the state, for people: "connection refused", "compiling"
    /// The two do not fit: another key, version or type. It is tried again, but will not do before
    /// one of them was started anew.
    bool unfit = false;
    std::string description = {};  ///< as the server said in its Hello
    std::uint64_t lastReady = 0;
    RenderStats stats = {};  ///< of lastReady
    Activity activity = Activity::idle;
    std::uint64_t current = 0;          ///< frame it is at; 0: none
    std::uint32_t busyMs = 0;           ///< for how long, when it was last asked
    std::optional<double> tripMs = {};  ///< shortest round trip of late
    std::string relay =
        {};  ///< the server that passes payloads on to it; empty: it gets them from us
    std::uint64_t toUpload = 0;  ///< bytes of payloads and snapshot still to be sent
    std::uint32_t lost = 0;      ///< how often it was dropped from the wall
    std::uint32_t rejoined = 0;  ///< how often it came back
};

/// Since the hub was made, to all servers together.
struct HubTotals {
    std::uint64_t frames = 0;
    std::uint64_t controlBytes = 0;
    std::uint64_t bulkBytes = 0;
    std::uint64_t sparedBytes = 0;    ///< of bulk, by compression
    std::uint64_t controlWrites = 0;  ///< calls of the operating system's send
    std::uint32_t lost = 0;
    std::uint32_t rejoined = 0;
};

}  // namespace gnomon::net
