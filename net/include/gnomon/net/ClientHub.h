#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/Type.h>
#include <gnomon/net/ClusterKey.h>
#include <gnomon/net/HubTypes.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace gnomon::net {

/// The client's end: keeps the session aspect, drives all servers in step, and never waits long
/// for one that fails.
///
/// The sockets and the session aspect (space 1) are worked on by whoever waits in frame(),
/// waitForAll() or takeImages(), and by a thread of the hub's own while the application is away.
/// The functions belong to one thread, the application's.
class ClientHub {
public:
    using Deadline = std::chrono::steady_clock::time_point;

    /// @param types  complete: the hub's thread reads it, so nothing may be added from now on.
    /// @param key    of the cluster: every server must have it, and all is sealed by TLS. Null:
    ///               only servers on loopback addresses are spoken to, in the clear.
    ClientHub(const field::TypeRegistry& types, SyncOptions options, HubHooks hooks,
              const SharedKey& key = {});
    /// As shutdown().
    ~ClientHub();
    ClientHub(const ClientHub&) = delete;
    ClientHub& operator=(const ClientHub&) = delete;

    /// Adds a server, or tells the new address of one that was restarted. Returns at once; the hub
    /// tries until shutdown, 50 ms to 2 s apart. One that is looked up is asked for anew whenever
    /// it was lost. @throws Failure Errc::config: no such group for lookups
    void connect(ServerAddress address);

    /// Waits until every server takes part. The error names those that do not, and why.
    /// @param progress  called on this thread whenever something changed; may be empty
    Result<void> waitForAll(const std::function<void(const std::vector<ServerStatus>&)>& progress,
                            Deadline deadline);

    /// Hands over frame n = 1, 2, ... and returns when n - pipeline is shown by every server that
    /// takes part. Never waits longer than the sync options allow; without any server a frame
    /// takes `timeout`, so that an application without a wall idles and the wall can come back.
    /// @param changes  of one aspect, of a space >= 2: its commits in order, none left out
    /// @param time     seconds, for the servers' animations
    /// @throws Failure what a hook threw; Errc::protocol: @p changes do not fit those before;
    ///         Errc::limit: they take more than 256 MiB; Errc::disconnected: after shutdown().
    FrameResult frame(field::ChangeList changes, double time, bool capture = false);

    /// The pictures of a frame that was handed over with capture = true. With pipeline > 0 the
    /// frame need not be shown when frame() returns; this waits for it. Each frame's can be taken
    /// once; only the newest two are kept.
    Result<std::vector<TileImage>> takeImages(std::uint64_t n, Deadline deadline);

    /// Input from the servers' windows since the last call, in order; the newest 4096.
    std::vector<InputEventFrom> takeEvents();

    std::vector<ServerStatus> status() const;
    HubTotals totals() const;

    /// Says goodbye to all servers and ends the thread; at most half a second.
    void shutdown();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::net
