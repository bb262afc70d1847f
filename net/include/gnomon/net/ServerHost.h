#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/Type.h>
#include <gnomon/net/ClusterKey.h>
#include <gnomon/net/ServerEvent.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace gnomon::net {

struct ServerOptions {
    std::string address = "127.0.0.1";  ///< numeric; see ServerHost for others than loopback
    std::uint16_t port = 0;             ///< 0: any free one
    std::string name = {};
    std::string description = {};  ///< for people: renderer, windows
    bool exitWithClient = false;   ///< Quit after the client left
    /// Of the cluster: clients without it get nowhere. Null: in the clear, on loopback only.
    SharedKey key = {};
    /// From the connection to the client's Hello, TLS included.
    std::chrono::milliseconds handshakeTimeout{5000};
    /// A client that sends nothing for so long is gone. (It pings several times a second.)
    std::chrono::milliseconds silentTimeout{30000};
    /// Who asks this group for the name is told the port, see parseLookupGroup(). Empty: nobody is.
    std::string announce = {};
    /// Most bytes of payloads kept for a session.
    std::uint64_t payloadBudget = std::uint64_t{16} << 30U;
    /// Told about everyone who was turned away, once a second at most, for people who run the
    /// server. From any thread.
    std::function<void(const std::string&)> turnedAway = {};
};

/// The server's end: takes one client at a time and hands its frames to the main thread.
///
/// next() works on the sockets while it waits; a thread of its own takes over, answers Ping and
/// puts payloads together, while the main thread is busy elsewhere for more than 20 ms. All
/// functions but quit() and port() belong to one thread, the one that calls next().
class ServerHost {
public:
    /// Listens at once.
    /// @param types  learns the client's types within next(), on the calling thread.
    /// @throws Failure Errc::config: the address is malformed or taken, or is not a loopback one,
    ///         which needs a key; or it cannot be announced.
    ServerHost(ServerOptions options, field::TypeRegistry& types);
    ~ServerHost();
    ServerHost(const ServerHost&) = delete;
    ServerHost& operator=(const ServerHost&) = delete;

    std::uint16_t port() const noexcept;

    /// Waits for the next event, in order; Nothing at the deadline.
    ServerEvent next(std::chrono::steady_clock::time_point deadline);
    /// Without waiting: is more there already, or was a millisecond ago?
    Queued peek() const;

    // Each is dropped silently when the client is gone.
    /// Once for the snapshot and for each frame that is rendered. Counts the images sent for this
    /// frame, so send them before.
    void send(Ready ready);
    void send(const Digest& digest);
    void send(const Digests& digests);
    void send(const Depth& depth);
    void send(const InputEvent& event);
    void send(const Log& log);  ///< cut at 4096 bytes
    void send(Image image);
    /// Told to the client with every Pong. next() sets loading for a snapshot and rendering for a
    /// frame; the main thread says when it compiles.
    void setActivity(Activity activity) noexcept;

    /// Makes next() return Quit. From any thread; not from a signal handler.
    void quit();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::net
