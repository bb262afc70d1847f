#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "HubCore.h"

namespace gnomon::net {
namespace {

/// What all servers see together; min > max: nothing.
struct MergedDepth {
    float min = std::numeric_limits<float>::max();
    float max = std::numeric_limits<float>::lowest();
    bool any = false;  ///< somebody told something

    void add(const Depth& depth) {
        any = true;
        if (depth.min > depth.max) return;
        min = std::min(min, depth.min);
        max = std::max(max, depth.max);
    }
};

}  // namespace

void HubCore::handOver(std::shared_ptr<FrameCall> call) {
    call->n = ++handedOver_;
    calls_.push_back(call);
    unprepared_.push_back(std::move(call));
    advance();
}

/// Does all that can be done now. What goes out at one moment goes out in one write per server.
void HubCore::advance() {
    if (advancing_) return;  // a hook that logs, a channel that fails
    advancing_ = true;
    if (failure_) failCalls();
    while (!failure_) {
        tryFit();
        if (outstanding_ && barrierDone()) swapFrame();
        const bool fitOpen =
            outstanding_ && outstanding_->frame.wantsDepth && !outstanding_->fitted;
        if (!prepared_ && !unprepared_.empty() && !fitOpen) {
            flushAll();  // a Swap does not wait for the next frame's preparation
            const auto call = std::move(unprepared_.front());
            unprepared_.pop_front();
            prepare(*call);
            continue;
        }
        if (outstanding_ || !prepared_) break;
        sendFrame();
        flushAll();
    }
    flushAll();
    completeCalls();
    watch();
    advancing_ = false;
}

void HubCore::prepare(FrameCall& call) {
    try {
        encode(call);
    } catch (...) {
        // The session aspect may be half changed: nothing can be built on it.
        failure_ = std::current_exception();
        failCalls();
    }
}

void HubCore::encode(FrameCall& call) {
    applied_.clear();
    field::ChangeList list = std::move(call.list);
    orThrow(session_.apply(list, &applied_));
    preparedN_ = call.n;
    preparedTime_ = call.time;
    ++sessionVersion_;
    if (hooks_.prepare) hooks_.prepare(session_, applied_, call.n);
    list.append(session_.commit());
    if (list.bytes.size() > maxChangeBytes - (std::size_t{16} << 20U))
        throw Failure{Errc::limit, fmt::format("frame {}: changes of {} bytes, the limit is {}",
                                               call.n, list.bytes.size(), maxChangeBytes)};

    std::vector<PayloadLedger::Kept> fresh;
    wire::Frame frame{.n = call.n, .time = call.time};
    frame.needed = ledger_.take(list, call.n, fresh);
    frame.released = ledger_.release(session_.takeUnusedPayloads(), call.n, options_.relay > 0);
    forgetReleased();
    const bool wantsDepth = hooks_.fit && hooks_.wantsDepth && hooks_.wantsDepth(session_, call.n);
    const bool tellsDepth =
        !wantsDepth && hooks_.depthSeen && hooks_.tellsDepth && hooks_.tellsDepth(session_, call.n);
    const bool digest =
        options_.digestEvery > 0 && call.n % static_cast<std::uint64_t>(options_.digestEvery) == 0;
    if (call.capture) frame.flags |= wire::Frame::capture;
    if (wantsDepth) frame.flags |= wire::Frame::wantsDepth;
    if (tellsDepth) frame.flags |= wire::Frame::tellsDepth;
    if (digest) {
        frame.flags |= wire::Frame::digest;
        noteDigest(call.n);
    }
    if (std::exchange(anyDrifts_, false)) {
        frame.flags |= wire::Frame::digests;
        noteDigests(call.n);
    }
    const Part changes = Part::of(std::move(list.bytes));
    frame.tail = changes.bytes;
    Prepared prepared{.n = call.n,
                      .capture = call.capture,
                      .wantsDepth = wantsDepth,
                      .tellsDepth = tellsDepth,
                      .head = Part::of(packet(frame)),
                      .changes = changes};
    prepared.bytes = prepared.head.bytes.size() + changes.bytes.size();
    for (const auto& kept : fresh) {
        prepared.payloadBytes += kept.payload.size();
        for (const auto& peer : peers_)
            if (peer->standing.joined && peer->standing.relay == nullptr) uploadTo(*peer, kept);
    }
    prepared_ = std::move(prepared);
}

/// When every member has told the depth range of the outstanding frame, its fit is made and sent.
void HubCore::tryFit() {
    if (!outstanding_ || !outstanding_->frame.wantsDepth || outstanding_->fitted) return;
    const std::uint64_t n = outstanding_->frame.n;
    MergedDepth merged;
    for (const auto& peer : peers_) {
        const Standing& standing = peer->standing;
        if (!standing.member || standing.lastReady >= n) continue;
        if (!standing.depth || standing.depth->n != n) return;
        merged.add(*standing.depth);
    }
    if (!merged.any) return;
    outstanding_->fitted = true;
    try {
        hooks_.fit(session_, n, merged.min, merged.max);
    } catch (...) {
        failure_ = std::current_exception();
        return failCalls();
    }
    ++sessionVersion_;
    auto list = session_.commit();
    GNOMON_EXPECTS(list.payloads.empty(), "a fit names payloads");
    if (digests_.contains(n)) noteDigest(n);
    if (eachDigest_.contains(n)) noteDigests(n);
    const Part changes = Part::of(std::move(list.bytes));
    const Part head = Part::of(packet(wire::Fit{.n = n, .tail = changes.bytes}));
    for (const auto& peer : peers_) {
        if (!peer->standing.joined || peer->standing.snapshot > n) continue;
        peer->queue(head);
        peer->queue(changes);
    }
    queued_ = true;
}

/// Of the outstanding frame, when it is about to be swapped.
void HubCore::noteDepth() {
    const std::uint64_t n = outstanding_->frame.n;
    MergedDepth merged;
    for (const auto& peer : peers_) {
        const Standing& standing = peer->standing;
        if (!standing.member || standing.lastReady < n) continue;
        // One that began with this frame, from a snapshot, was not asked.
        if (!standing.depth || standing.depth->n != n) return;
        merged.add(*standing.depth);
    }
    if (merged.any) hooks_.depthSeen(n, merged.min, merged.max);
}

void HubCore::sendFrame() {
    const auto now = SteadyClock::now();
    std::vector<std::string> members;
    for (const auto& peer : peers_) {
        const Standing& standing = peer->standing;
        if (!standing.joined || prepared_->n <= standing.snapshot) continue;
        peer->queue(prepared_->head);
        peer->queue(prepared_->changes);
        if (standing.member) members.push_back(peer->name());
    }
    if (prepared_->capture) captures_.begin(prepared_->n, members);
    sentN_ = prepared_->n;
    sentLately_.emplace_back(sentN_, now);
    while (now - sentLately_.front().second > options_.timeout && sentLately_.size() > 1)
        sentLately_.pop_front();
    latest_.bytes = prepared_->bytes + 16;
    latest_.payloadBytes = prepared_->payloadBytes;
    outstanding_ = Outstanding{.frame = *std::move(prepared_), .sentAt = now};
    recount_ = queued_ = true;
    prepared_.reset();
}

void HubCore::countAwaited() {
    recount_ = false;
    members_ = awaited_ = 0;
    for (const auto& peer : peers_) {
        if (!peer->standing.member) continue;
        ++members_;
        if (!peer->standing.anyReady || peer->standing.lastReady < outstanding_->frame.n)
            ++awaited_;
    }
}

bool HubCore::barrierDone() {
    if (peers_.empty()) return true;
    if (recount_) countAwaited();
    if (members_ > 0) return awaited_ == 0;
    return SteadyClock::now() >= outstanding_->sentAt + options_.timeout;
}

void HubCore::swapFrame() {
    const std::uint64_t n = outstanding_->frame.n;
    if (outstanding_->frame.tellsDepth) noteDepth();
    const Part part = Part::of(packet(wire::Swap{.n = n}));
    for (const auto& peer : peers_) sendSwap(*peer, n, part);
    queued_ = true;
    latest_.shown = n;
    latest_.ms = millisecondsOf(SteadyClock::now() - outstanding_->sentAt);
    latest_.waitedFor = outstanding_->readyLast;
    latest_.skewMs = skewOf(n - 1);
    captures_.shown(n);
    if (outstanding_->frame.capture) changed();
    swappedN_ = n;
    outstanding_.reset();
}

void HubCore::sendSwap(Peer& peer, std::uint64_t n, const Part& part) {
    Standing& standing = peer.standing;
    if (!standing.joined || n < standing.snapshot || standing.lastSwap >= n) return;
    standing.lastSwap = n;
    peer.queue(part);
}

std::optional<double> HubCore::skewOf(std::uint64_t n) const {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    for (const auto& peer : peers_) {
        const Standing& standing = peer->standing;
        if (!standing.member || standing.shownFrame != n || n == 0) continue;
        first = std::min(first, standing.shownAt);
        last = std::max(last, standing.shownAt);
    }
    if (first > last) return {};
    return static_cast<double>(static_cast<std::uint64_t>(last) -
                               static_cast<std::uint64_t>(first)) *
           1e-6;
}

void HubCore::flushAll() {
    if (!std::exchange(queued_, false)) return;
    for (const auto& peer : peers_) peer->flush();
}

void HubCore::completeCalls() {
    const auto ahead = static_cast<std::uint64_t>(std::clamp(options_.pipeline, 0, 2));
    while (!calls_.empty() && calls_.front()->n <= swappedN_ + ahead) {
        const auto call = std::move(calls_.front());
        calls_.pop_front();
        FrameResult result = latest_;
        latest_.droppedNow.clear();
        latest_.joinedNow.clear();
        result.n = call->n;
        call->result = std::move(result);
        call->done = true;
    }
}

void HubCore::failCalls() {
    unprepared_.clear();
    for (const auto& call : std::exchange(calls_, {})) {
        call->error = failure_;
        call->done = true;
    }
}

}  // namespace gnomon::net
