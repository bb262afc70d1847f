// Who takes part: joining, being late, being lost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "HubCore.h"

namespace gnomon::net {
namespace {

/// Bytes a millisecond that everybody can be expected to take in and upload to a GPU; slower
/// servers than that get no extra time.
constexpr std::uint64_t loadingPace = 10'000;
/// After a deadline passed the sockets are looked at once more: if this thread itself was held up,
/// the answers lie there already.
constexpr Milliseconds secondLook{5};

}  // namespace

/// The peer's two connections stand. From here on it gets every frame; what came before is in the
/// snapshot.
void HubCore::connected(Peer& peer) {
    peer.standing.joined = true;
    peer.standing.snapshot = preparedN_;
    provide(peer, relayFor(peer));
    sendSnapshot(peer);
}

void HubCore::uploadTo(Peer& peer, const PayloadLedger::Kept& kept) {
    auto owner = std::make_shared<const field::Payload>(kept.payload);
    const auto bytes = owner->bytes();
    peer.bulk().add(
        {.whole = {.owner = owner, .bytes = bytes},
         .head = [hash = kept.payload.hash(), serial = kept.serial, total = kept.payload.size()](
                     std::uint64_t offset, std::span<const std::byte> chunk) {
             return packet(wire::Payload{
                 .hash = hash, .serial = serial, .total = total, .offset = offset, .tail = chunk});
         }});
}

void HubCore::sendSnapshot(Peer& peer) {
    if (snapshotVersion_ != sessionVersion_) {  // servers that start together share one
        const field::ChangeList list = session_.snapshot();
        snapshot_ =
            Part::of(body(wire::SnapshotBody{.needed = ledger_.names(), .tail = list.bytes}));
        snapshotVersion_ = sessionVersion_;
    }
    const std::uint64_t total = snapshot_.bytes.size();
    if (total > maxSnapshotBytes) {
        log(LogLevel::error, fmt::format("{}: a snapshot of {} bytes, the limit is {}",
                                         peer.label(), total, maxSnapshotBytes));
        return;  // it stays a joiner until its startTimeout
    }
    peer.bulk().add(
        {.whole = snapshot_,
         .head = [n = preparedN_, time = preparedTime_, total](std::uint64_t offset,
                                                               std::span<const std::byte> chunk) {
             return packet(wire::Snapshot{
                 .n = n, .time = time, .total = total, .offset = offset, .tail = chunk});
         }});
}

/// A joiner takes part from the first frame that it finished while that frame was still fresh:
/// the outstanding one, or one sent so lately that it will keep up with the timeout. (To wait for
/// the outstanding frame alone would shut out a server that is slower than the others for ever.)
bool HubCore::mayJoin(std::uint64_t ready) const {
    if (ready >= (outstanding_ ? outstanding_->frame.n : sentN_)) return true;
    const auto found = std::find_if(sentLately_.begin(), sentLately_.end(),
                                    [&](const auto& sent) { return sent.first == ready; });
    return found != sentLately_.end() && SteadyClock::now() - found->second < options_.timeout / 2;
}

Result<void> HubCore::ready(Peer& peer, const Ready& ready) {
    Standing& standing = peer.standing;
    if (!standing.joined || ready.n > preparedN_ || ready.n < standing.snapshot ||
        (standing.anyReady && ready.n <= standing.lastReady))
        return fail(Errc::protocol,
                    fmt::format("Ready {} out of turn, after {}", ready.n, standing.lastReady));
    if (standing.member && outstanding_ && standing.lastReady < outstanding_->frame.n &&
        ready.n >= outstanding_->frame.n)
        --awaited_;
    standing.anyReady = true;
    standing.lastReady = ready.n;
    standing.stats = ready.stats;
    standing.shownFrame = ready.shownFrame;
    if (const auto offset = peer.clock().offset())
        standing.shownAt = clockDifference(ready.shownAt, *offset);
    else
        standing.shownFrame = 0;
    captures_.expect(ready.n, peer.name(), ready.images);

    if (!standing.member && mayJoin(ready.n)) {
        if (peer.everMember) {
            ++rejoinedCount_;
            log(LogLevel::info, peer.label() + ": takes part again");
        }
        peer.becomeMember();
        recount_ = true;
        latest_.joinedNow.push_back(peer.name());
        // The newest swap may have been before its snapshot was made.
        if (swappedN_ > 0 && swappedN_ >= standing.snapshot) {
            sendSwap(peer, swappedN_, Part::of(packet(wire::Swap{.n = swappedN_})));
            peer.flush();
        }
    }
    if (standing.member && outstanding_ && ready.n == outstanding_->frame.n) {
        if (!outstanding_->firstReady) outstanding_->firstReady = SteadyClock::now();
        outstanding_->readyLast = peer.name();
    }
    advance();
    return {};
}

Result<void> HubCore::depth(Peer& peer, const Depth& depth) {
    if (!std::isfinite(depth.min) || !std::isfinite(depth.max))
        return fail(Errc::protocol, fmt::format("Depth {}: a bound is not finite", depth.n));
    peer.standing.depth = depth;
    advance();
    return {};
}

void HubCore::lost(Peer& peer, const Error&) {
    recount_ = true;
    leaveTree(peer);
    if (peer.standing.member) {
        ++lostCount_;
        latest_.droppedNow.push_back(peer.name());
    }
    captures_.lost(peer.name());
    // Posted: peers are lost in loops over them.
    asio::post(io_, [this] {
        if (stopped_)
            endIfSilent();
        else
            advance();
    });
}

bool HubCore::anyMember() const {
    return std::any_of(peers_.begin(), peers_.end(),
                       [](const auto& peer) { return peer->standing.member; });
}

Milliseconds HubCore::allowance() const {
    const auto bytes = outstanding_->frame.bytes + outstanding_->frame.payloadBytes;
    return std::min(options_.startTimeout,
                    Milliseconds{static_cast<Milliseconds::rep>(bytes / loadingPace)});
}

/// When a member that is not ready counts as late. Before anybody is ready, everybody may be
/// compiling: then only silence tells a dead server, until startTimeout.
TimePoint HubCore::dueOf(const Peer& peer) const {
    if (options_.waitForLate) return TimePoint::max();
    const Outstanding& out = *outstanding_;
    const auto began = std::max(out.sentAt, peer.standing.memberSince);
    auto from = std::max(began, peer.lastProgress());
    auto due = from + options_.startTimeout;
    if (out.firstReady) due = std::max(from, *out.firstReady) + options_.timeout + allowance();
    const auto silent = std::max(began + options_.timeout,
                                 peer.lastHeard() + options_.timeout + 2 * options_.pingInterval);
    return std::min({due, silent, began + options_.startTimeout + allowance()});
}

/// Arms the timer where a frame is outstanding. Deadlines only move later, or come no sooner than
/// `timeout` from now, so an armed timer is left alone: a frame in time costs no timer call.
void HubCore::watch() {
    if (stopped_ || !outstanding_ || watchTimer_.armed()) return;
    auto due = SteadyClock::now() + options_.timeout;
    if (anyMember()) {
        for (const auto& peer : peers_)
            if (peer->standing.member && peer->standing.lastReady < outstanding_->frame.n)
                due = std::min(due, dueOf(*peer));
    } else {
        due = outstanding_->sentAt + options_.timeout;
    }
    watchTimer_.at(due, [this] { look(false); });
}

void HubCore::look(bool confirmed) {
    if (!outstanding_) return;
    const auto now = SteadyClock::now();
    std::vector<Peer*> late;
    for (const auto& peer : peers_)
        if (peer->standing.member && peer->standing.lastReady < outstanding_->frame.n &&
            now >= dueOf(*peer))
            late.push_back(peer.get());
    if (!late.empty() && !confirmed) return watchTimer_.after(secondLook, [this] { look(true); });
    for (Peer* peer : late) dropLate(*peer);
    advance();  // also where nobody takes part and the frame's time is over
}

void HubCore::dropLate(Peer& peer) {
    const auto now = SteadyClock::now();
    const auto& first = outstanding_->firstReady;
    const auto& pong = peer.lastPong();
    // What a server said before it fell silent is no excuse.
    std::string at = "it answers nothing";
    if (now - peer.lastHeard() < options_.timeout && pong) {
        at = pong->current == 0
                 ? fmt::format("it is idle, last finished frame {}", pong->lastFinished)
                 : fmt::format("it was at frame {} for {} ms", pong->current, pong->busyMs);
    }
    peer.drop({.code = Errc::timeout,
               .what = fmt::format("{}: dropped at frame {}: not ready {:.0f} ms after {} ({})",
                                   peer.label(), outstanding_->frame.n,
                                   millisecondsOf(now - (first ? *first : outstanding_->sentAt)),
                                   first ? "the first server" : "the frame was sent", at)});
}

}  // namespace gnomon::net
