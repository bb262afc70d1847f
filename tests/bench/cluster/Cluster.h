#pragma once

#include <gnomon/client/Launcher.h>
#include <gnomon/net/ClientHub.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace gnomon::bench {

struct ClusterOptions {
    std::filesystem::path program = {};  ///< gnomon-server
    int servers = 1;
    std::filesystem::path key = {};  ///< cluster key: TLS; empty: in the clear
    int pipeline = 1;                ///< SyncOptions::pipeline
    int relay = 0;                   ///< servers a machine sends to itself; 0: all
};

/// Null-render servers, each a process of its own, and a hub that they all take part with.
class Cluster {
public:
    explicit Cluster(const ClusterOptions& options);

    /// Connects to all and waits until they take part; what the session is then has reached them.
    void join();
    const field::TypeRegistry& types() const noexcept { return types_; }
    net::ClientHub& hub() noexcept { return *hub_; }

private:
    field::TypeRegistry types_;
    std::vector<net::ServerAddress> addresses_;
    std::unique_ptr<client::Launcher> launcher_;
    std::unique_ptr<net::ClientHub> hub_;
};

}  // namespace gnomon::bench
