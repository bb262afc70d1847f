#pragma once

#include <gnomon/client/Application.h>
#include <gnomon/net/ClientHub.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <string>

#include "ClusterAccess.h"

namespace gnomon::client {

/// The servers of a wall: launched where they are local, connected, started again.
/// Belongs to the application's thread.
class ServerLink {
public:
    /// Launches local servers at once. @p types outlives this and is complete.
    ServerLink(const config::Config& config, const field::TypeRegistry& types,
               const ApplicationOptions& options);
    ~ServerLink();

    /// Frame 1 with everything, then the connections, then waits. Servers that join a session that
    /// is complete take part as soon as they have loaded it, and nobody waits for the slowest.
    Result<void> start(field::ChangeList everything, const Application::StatusCallback& progress,
                       const std::function<bool()>& keepGoing);
    net::FrameResult frame(field::ChangeList changes, double time, bool capture);
    void shutdown();

    net::ClientHub& hub() noexcept { return hub_; }
    const net::ClientHub& hub() const noexcept { return hub_; }
    std::vector<int> processes() const;
    std::chrono::milliseconds startTimeout() const noexcept { return sync_.startTimeout; }

private:
    /// Tells the hub of servers that listen since the last call: its functions are for one thread.
    void connectNew();
    net::HubHooks hooks() const;
    Result<void> startedFit() const;
    Result<void> silentServers() const;

    const LogCallback log_;
    const net::SyncOptions sync_;
    const KeyFile keyFile_;
    std::atomic<bool> ending_{false};
    std::mutex mutex_;
    std::condition_variable listens_;                 // a server that is not yet in the hub
    std::vector<net::ServerAddress> listening_ = {};  // guarded
    std::vector<net::ServerAddress> remote_ = {};
    std::size_t launched_ = 0;             // servers started from here
    std::set<std::string> listened_ = {};  // those of them that ever said their port
    net::ClientHub hub_;
    std::unique_ptr<Launcher> launcher_ = {};
};

}  // namespace gnomon::client
