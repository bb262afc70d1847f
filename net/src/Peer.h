#pragma once

#include <gnomon/net/HubTypes.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "BulkSender.h"
#include "Candidates.h"
#include "Channel.h"
#include "ClockFilter.h"
#include "Dialer.h"
#include "Finder.h"
#include "Timer.h"

namespace gnomon::net {

class Peer;

/// What a Peer tells the hub. Called on the Asio thread.
class PeerOwner {
public:
    virtual ~PeerOwner() = default;
    /// The Hello to greet with; the peer fills in role and token.
    virtual wire::ClientHello greeting() = 0;
    virtual Result<void> checkSchema(std::span<const std::byte> schema, const std::string& who) = 0;
    /// Both connections stand: upload the session.
    virtual void connected(Peer& peer) = 0;
    /// Its connections are gone; @p standing is what it had achieved with them.
    virtual void lost(Peer& peer, const Error& why) = 0;
    virtual Result<void> ready(Peer& peer, const Ready& ready) = 0;
    virtual Result<void> depth(Peer& peer, const Depth& depth) = 0;
    virtual void digest(Peer& peer, const Digest& digest) = 0;
    virtual void digests(Peer& peer, const Digests& digests) = 0;
    virtual void event(Peer& peer, const InputEvent& event) = 0;
    virtual Result<void> image(Peer& peer, Image image) = 0;
    virtual void relayLost(Peer& peer, const wire::RelayLost& lost) = 0;
    virtual void log(LogLevel level, const std::string& text) = 0;
    /// Something status() shows is different.
    virtual void changed() = 0;
};

/// Where a server stands in the session, from the connection on. Kept by the hub.
struct Standing {
    bool joined = false;  ///< the snapshot is on its way; gets all frames after it
    bool member = false;  ///< the barrier waits for it
    TimePoint memberSince = {};
    std::uint64_t snapshot = 0;  ///< the frame it begins with
    std::uint64_t lastSwap = 0;  ///< sent
    std::uint64_t lastReady = 0;
    bool anyReady = false;
    /// The frame up to which it has applied all, so far as we know.
    std::uint64_t applied() const noexcept { return std::max(lastReady, snapshot); }
    RenderStats stats = {};
    std::optional<Depth> depth = {};
    std::uint64_t shownFrame = 0;
    std::int64_t shownAt = 0;  ///< nanoseconds of our clock
    bool drifting = false;     ///< its copy of the scene is not the session's
    Peer* relay = nullptr;     ///< passes payloads on to it; nullptr: it gets them from us
    int level = 0;             ///< relays between it and us
    int relays = 0;            ///< servers it passes payloads on to
};

/// One server as the client sees it: looks it up where that is asked for, connects, greets, does so
/// again when it was lost, and keeps the clock. What frames it gets is the hub's business.
class Peer final : public Receiver {
public:
    /// @param tls  null: in the clear, and to this machine only
    /// @throws Failure Errc::config: no such group for lookups
    Peer(asio::io_context& io, ServerAddress address, const SyncOptions& options, PeerOwner& owner,
         std::shared_ptr<const TlsContext> tls, Packer& packer);

    /// Connects now; a connection to another address ends.
    void open(ServerAddress address);
    /// Closes the connections, tells the owner, and tries again later.
    void drop(Error why);
    /// Says goodbye; no more attempts. drop() or silence ends it.
    void stop();
    bool silent() const noexcept { return !control_ && !bulkChannel_; }

    void queue(const Part& part) {
        if (control_) control_->queue(part);
    }
    void flush() {
        if (control_) control_->flush();
    }
    /// Begins a membership: the next loss is retried at once.
    void becomeMember();

    const std::string& name() const noexcept { return address_.name; }
    /// "left2 (127.0.0.1:4711)"
    std::string label() const;
    const ServerAddress& address() const noexcept { return address_; }
    /// Of its session; another with each connection.
    std::uint64_t token() const noexcept { return token_; }
    /// When we last sent or it last got something large.
    TimePoint lastProgress() const noexcept { return std::max(bulk_.lastProgress(), arrivedAt_); }
    ServerStatus status() const;
    BulkSender& bulk() noexcept { return bulk_; }
    const BulkSender& bulk() const noexcept { return bulk_; }
    const ClockFilter& clock() const noexcept { return clock_; }
    const std::optional<wire::Pong>& lastPong() const noexcept { return pong_; }
    TimePoint lastHeard() const noexcept { return control_ ? control_->lastHeard() : TimePoint{}; }
    std::uint64_t controlBytes() const noexcept;
    std::uint64_t controlWrites() const noexcept;
    std::uint64_t bulkBytes() const noexcept;

    Standing standing = {};
    std::uint32_t timesLost = 0;
    std::uint32_t timesRejoined = 0;
    bool everMember = false;

    bool driftNamed = false;  ///< once it was said in what

    Result<void> received(Channel& from, MessageType type,
                          std::span<const std::byte> body) override;
    void secured(Channel& channel) override;
    void drained(Channel& channel) override;
    void closed(Channel& channel, Error why) override;

private:
    using Connected = void (Peer::*)(tcp::socket socket);

    void connect();
    void attempt();
    void look();
    void heard(const Finder::Heard& from);
    void tryNext(std::optional<SteadyClock::duration> after = {});
    Place place() const { return {.host = address_.host, .port = address_.port}; }
    void dial(Connected then);
    void greet(tcp::socket socket);
    void awaitHello();
    std::unique_ptr<TlsSession> seal() const;
    void joinBulk(tcp::socket socket);
    Result<void> welcome(std::span<const std::byte> body);
    Result<void> pongArrived(std::span<const std::byte> body);
    Result<void> imagePart(std::span<const std::byte> body);
    void ping();
    void watchLoading();
    void closeAll();
    std::string stateText() const;

    ServerAddress address_;
    const SyncOptions& options_;
    PeerOwner& owner_;
    const std::shared_ptr<const TlsContext> tls_;
    ServerState state_ = ServerState::waiting;
    bool stopping_ = false;
    std::uint64_t token_ = 0;
    Dialer dialer_;
    std::unique_ptr<Finder> finder_;  // null: where the server is was said
    Candidates candidates_;
    bool saidLooking_ = false;  // since it was a member
    std::string saidFound_;     // the same
    bool saidVersion_ = false;  // in this lookup
    std::shared_ptr<Channel> control_;
    std::shared_ptr<Channel> bulkChannel_;
    BulkSender bulk_;
    ClockFilter clock_;
    std::optional<wire::Pong> pong_;
    int pings_ = 0;
    std::uint64_t arrived_ = 0;  // bytes, as it said
    TimePoint arrivedAt_ = {};
    std::optional<Image> image_;  // arriving
    std::uint64_t imageArrived_ = 0;
    std::string description_;
    std::string lastError_, lastLogged_;
    bool unfit_ = false;  // see ServerStatus
    Milliseconds retryDelay_{50};
    Timer timer_, pingTimer_;
    std::uint64_t pastControlBytes_ = 0, pastControlWrites_ = 0, pastBulkBytes_ = 0;
};

}  // namespace gnomon::net
