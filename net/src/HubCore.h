#pragma once

#include <gnomon/net/ClientHub.h>

#include <deque>
#include <exception>
#include <map>
#include <memory>

#include "CaptureBoard.h"
#include "PayloadLedger.h"
#include "Peer.h"

namespace gnomon::net {

/// A frame on its way from the application and back.
struct FrameCall {
    field::ChangeList list = {};
    double time = 0;
    bool capture = false;
    std::uint64_t n = 0;  // given by the core
    bool done = false;
    FrameResult result = {};
    std::exception_ptr error = {};
};

/// ClientHub's logic: everything here runs on the thread that has the Reactor.
///
/// A frame is handed over, prepared (applied to the session aspect and encoded, once), sent, and
/// swapped. At most one is outstanding (sent, not swapped) and one prepared; what the session
/// aspect contains is therefore frame preparedN_.
class HubCore final : public PeerOwner {
public:
    HubCore(asio::io_context& io, const field::TypeRegistry& types, SyncOptions options,
            HubHooks hooks, const SharedKey& key);

    void connect(ServerAddress address);
    void handOver(std::shared_ptr<FrameCall> call);
    std::optional<Result<std::vector<TileImage>>> takeImages(std::uint64_t n) {
        return captures_.take(n);
    }
    std::string imagesWaitFor(std::uint64_t n) const { return captures_.waitingFor(n); }
    std::vector<ServerStatus> status() const;
    /// Counts what status() shows.
    std::uint64_t version() const noexcept { return version_; }
    HubTotals totals() const;
    std::deque<InputEventFrom> takeEvents() { return std::exchange(events_, {}); }
    /// Servers will answer soon, and then there is more to do.
    bool busy() const noexcept { return outstanding_ || prepared_ || !unprepared_.empty(); }
    /// Says goodbye; @p done is called when all have answered, or after a while.
    void stop(std::function<void()> done);

    wire::ClientHello greeting() override;
    Result<void> checkSchema(std::span<const std::byte> schema, const std::string& who) override;
    void connected(Peer& peer) override;
    void lost(Peer& peer, const Error& why) override;
    Result<void> ready(Peer& peer, const Ready& ready) override;
    Result<void> depth(Peer& peer, const Depth& depth) override;
    void digest(Peer& peer, const Digest& digest) override;
    void digests(Peer& peer, const Digests& digests) override;
    void event(Peer& peer, const InputEvent& event) override;
    Result<void> image(Peer& peer, Image image) override;
    void relayLost(Peer& peer, const wire::RelayLost& lost) override;
    void log(LogLevel level, const std::string& text) override;
    void changed() override;

private:
    struct Prepared {
        std::uint64_t n = 0;
        bool capture = false;
        bool wantsDepth = false;
        bool tellsDepth = false;
        Part head = {};     // length, type and fields of Frame
        Part changes = {};  // its tail
        std::uint64_t bytes = 0;
        std::uint64_t payloadBytes = 0;
    };
    struct Outstanding {
        Prepared frame = {};
        TimePoint sentAt = {};
        std::optional<TimePoint> firstReady = {};
        std::string readyLast = {};
        bool fitted = false;
    };

    // HubFrames.cpp: handing over, preparing, sending, swapping.
    void advance();
    void prepare(FrameCall& call);
    void encode(FrameCall& call);
    void tryFit();
    void noteDepth();
    void sendFrame();
    void swapFrame();
    bool barrierDone();
    void countAwaited();
    void sendSwap(Peer& peer, std::uint64_t n, const Part& part);
    void flushAll();
    void completeCalls();
    void failCalls();
    std::optional<double> skewOf(std::uint64_t n) const;
    void noteDigest(std::uint64_t n);
    void noteDigests(std::uint64_t n);
    std::string differences(const Digests& theirs) const;

    // HubRelay.cpp: who gets payloads from whom.
    Peer* relayFor(const Peer& peer) const;
    void provide(Peer& peer, Peer* relay);
    void forgetReleased();
    void leaveTree(Peer& peer);

    // HubMembers.cpp: joining, lateness, loss.
    bool mayJoin(std::uint64_t ready) const;
    void uploadTo(Peer& peer, const PayloadLedger::Kept& kept);
    void sendSnapshot(Peer& peer);
    void watch();
    void look(bool confirmed);
    TimePoint dueOf(const Peer& peer) const;
    void dropLate(Peer& peer);
    Milliseconds allowance() const;
    bool anyMember() const;
    void endIfSilent();

    asio::io_context& io_;
    const field::TypeRegistry& types_;
    const SyncOptions options_;
    const HubHooks hooks_;
    const std::shared_ptr<const TlsContext> tls_;  // null: no key

    field::Aspect session_;
    field::Applied applied_;
    PayloadLedger ledger_;
    Packer packer_;
    CaptureBoard captures_;
    std::map<std::uint64_t, std::uint64_t> digests_;  // by frame, the newest few
    bool anyDrifts_ = false;                          // the next frame asks for all Digests
    std::map<std::uint64_t, std::vector<field::ContainerDigest>> eachDigest_;  // the newest two

    std::vector<std::unique_ptr<Peer>> peers_;
    std::deque<std::shared_ptr<FrameCall>> unprepared_, calls_;
    std::optional<Prepared> prepared_;
    std::optional<Outstanding> outstanding_;
    std::uint64_t handedOver_ = 0, preparedN_ = 0, sentN_ = 0, swappedN_ = 0;
    double preparedTime_ = 0;
    std::deque<std::pair<std::uint64_t, TimePoint>> sentLately_;
    std::exception_ptr failure_;
    // Counted anew when a frame is sent or membership changes, so that a Ready costs the same
    // however many servers there are.
    std::size_t members_ = 0, awaited_ = 0;
    bool recount_ = true;
    bool queued_ = false;  // something, with any peer

    Part snapshot_;  // of snapshotVersion_
    std::uint64_t sessionVersion_ = 0, snapshotVersion_ = ~std::uint64_t{0};

    std::uint64_t version_ = 0;
    std::deque<InputEventFrom> events_;
    FrameResult latest_;  // what the next completed call reports
    Timer watchTimer_, stopTimer_;
    std::function<void()> stopped_;
    bool advancing_ = false;
    std::uint32_t lostCount_ = 0, rejoinedCount_ = 0;
};

}  // namespace gnomon::net
