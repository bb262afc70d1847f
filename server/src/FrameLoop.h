#pragma once

#include <gnomon/net/ServerHost.h>

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "Options.h"
#include "Station.h"

namespace gnomon::server {

/// What the main thread does: takes frames, keeps the render aspect, draws, shows.
class FrameLoop {
public:
    /// Makes the context and listens, so that what cannot work fails at the start.
    /// @throws Failure
    explicit FrameLoop(Options options);

    std::uint16_t port() const noexcept { return host_->port(); }
    net::ServerHost& host() noexcept { return *host_; }
    /// Until the client says goodbye (local servers) or quit() is called. @throws Failure
    void run();

private:
    /// The containers a client sent, and what is drawn of them.
    struct Session {
        std::unique_ptr<field::Aspect> scene = {};
        std::vector<const scene::Window*> windows = {};  ///< ours
        std::uint64_t drawnFrame = 0;
        std::uint32_t skipped = 0;  ///< frames applied, not drawn, since the last Ready
        bool drawn = false;
        net::Depth depth = {};  ///< of drawnFrame, where it was told
        bool depthKnown = false;
    };

    void join(const net::ClientJoined& joined);
    void take(const net::Snapshot& snapshot);
    void take(const net::Frame& frame);
    void take(const net::Fit& fit);
    void show(std::uint64_t n);
    void leave(const std::string& why);
    /// Applies and passes on; true where anything changed.
    bool apply(const field::ChangeList& changes);
    void renderFrame(std::uint64_t n, double time, bool capture, bool changed,
                     std::chrono::steady_clock::time_point since, bool tellsDepth = false);
    void sendDigests(const net::Frame& frame);
    /// @param drawn  of the pictures as they are; else depth alone is drawn first
    void tellDepth(std::uint64_t n, bool drawn);
    void findWindows(const field::Applied& applied);
    void sendEvents();
    Station& station(int gpu);
    Station& stationOf(const scene::Window& window);
    void report(net::LogLevel level, const std::string& text);

    Options options_;
    field::TypeRegistry types_;
    std::map<int, std::unique_ptr<Station>> stations_;  ///< by GPU; empty with backend none
    std::unique_ptr<net::ServerHost> host_;
    std::optional<Session> session_;
    std::uint64_t shownFrame_ = 0;
    std::int64_t shownAt_ = 0;
    std::optional<net::Frame> waiting_;  ///< for its Fit
    bool waitingChanged_ = false;
};

}  // namespace gnomon::server
