#include "FrameGate.h"

#include <fmt/format.h>

#include <algorithm>

#include "LargePages.h"

namespace gnomon::net {
namespace {

/// What an event takes beside its change list: many tiny ones must count, too.
constexpr std::size_t eventBytes = 256;

/// Reserved before the bytes are there: address space, no memory yet.
constexpr std::size_t atOnce = std::size_t{1} << 30U;

std::size_t bytesOf(const field::ChangeList& changes) { return changes.bytes.size() + eventBytes; }

std::string text(const field::Hash128& hash) {
    return fmt::format("{:016x}{:016x}", hash.high, hash.low);
}

}  // namespace

Result<void> FrameGate::payload(const wire::Payload& part, Source source) {
    auto& slot = upload(source);
    if (!slot) {
        if (part.offset != 0)
            return fail(Errc::protocol, "payload " + text(part.hash) + " does not begin at byte 0");
        if (part.total > budget_ - std::min(budget_, keptBytes_))
            return fail(Errc::limit, fmt::format("payloads of {} bytes and another of {}: the "
                                                 "limit is {}",
                                                 keptBytes_, part.total, budget_));
        slot = Upload{.hash = part.hash, .serial = part.serial, .total = part.total};
    }
    Upload& upload = *slot;
    if (upload.hash != part.hash || upload.serial != part.serial || upload.total != part.total ||
        upload.bytes.size() != part.offset)
        return fail(Errc::protocol,
                    fmt::format("payload {} at byte {} of {}: found byte {} of {}, of {}",
                                text(upload.hash), upload.bytes.size(), upload.total, part.offset,
                                part.total, text(part.hash)));
    if (upload.bytes.capacity() < upload.bytes.size() + part.tail.size()) {
        // Doubling, but not beyond the size that was announced.
        const auto doubled = std::max(2 * (upload.bytes.size() + part.tail.size()), atOnce);
        reserveInLargePages(upload.bytes, std::min<std::size_t>(doubled, upload.total));
    }
    upload.bytes.insert(upload.bytes.end(), part.tail.begin(), part.tail.end());
    bytesArrived_ += part.tail.size();
    if (upload.bytes.size() < upload.total) {
        if (watch_ != nullptr) watch_->arriving(part);
        return {};
    }
    Upload whole = std::move(*slot);
    slot.reset();
    return keep(std::move(whole));
}

Result<void> FrameGate::keep(Upload whole) {
    field::Payload payload{std::move(whole.bytes)};
    if (payload.hash() != whole.hash)
        return fail(Errc::protocol,
                    fmt::format("payload {} of {} bytes has the content hash {}", text(whole.hash),
                                whole.total, text(payload.hash())));
    if (watch_ != nullptr) watch_->arrived(whole.serial, payload);
    if (released_.contains(whole.serial)) return {};  // came from elsewhere before
    auto& kept = kept_[whole.hash];
    if (!kept.payload) keptBytes_ += payload.size();
    kept = {.payload = std::move(payload), .serial = std::max(whole.serial, kept.serial)};
    return drain();
}

std::span<const std::byte> FrameGate::unfinished(std::uint64_t serial) const noexcept {
    std::span<const std::byte> most;
    for (const auto& upload : uploads_)
        if (upload && upload->serial == serial && upload->bytes.size() > most.size())
            most = upload->bytes;
    return most;
}

Result<void> FrameGate::snapshot(const wire::Snapshot& part) {
    if (started_ || beginning_) return fail(Errc::protocol, "a second Snapshot");
    if (snapshot_.size() != part.offset)
        return fail(Errc::protocol, fmt::format("Snapshot at byte {}: found byte {}",
                                                snapshot_.size(), part.offset));
    if (part.offset == 0) reserveInLargePages(snapshot_, std::min<std::size_t>(part.total, atOnce));
    snapshot_.insert(snapshot_.end(), part.tail.begin(), part.tail.end());
    bytesArrived_ += part.tail.size();
    if (snapshot_.size() < part.total) return {};

    auto body = decode<wire::SnapshotBody>(snapshot_);
    if (!body) return tl::unexpected{std::move(body).error()};
    const auto head = static_cast<std::ptrdiff_t>(snapshot_.size() - body->tail.size());
    snapshot_.erase(snapshot_.begin(), snapshot_.begin() + head);
    beginning_ = WaitingSnapshot{
        .snapshot = {.n = part.n, .time = part.time, .changes = {.bytes = std::move(snapshot_)}},
        .needed = std::move(body->needed)};
    snapshot_ = {};
    return drain();
}

bool FrameGate::haveAll(const std::vector<wire::PayloadName>& needed) const {
    return std::all_of(needed.begin(), needed.end(),
                       [&](const auto& name) { return kept_.contains(name.hash); });
}

void FrameGate::give(const std::vector<wire::PayloadName>& needed,
                     field::ChangeList& changes) const {
    for (const auto& name : needed)
        changes.payloads.push_back(kept_.find(name.hash)->second.payload);
}

/// Hands the snapshot on, now that all it names is there.
void FrameGate::begin() {
    Snapshot& snapshot = beginning_->snapshot;
    give(beginning_->needed, snapshot.changes);
    started_ = true;
    first_ = lastFrame_ = snapshot.n;
    const std::size_t bytes = bytesOf(snapshot.changes);
    emit_(std::move(snapshot), bytes);
    beginning_.reset();
}

Result<void> FrameGate::frame(wire::Frame message) {
    WaitingFrame waiting{
        .frame = {.n = message.n,
                  .time = message.time,
                  .capture = (message.flags & wire::Frame::capture) != 0,
                  .digest = (message.flags & wire::Frame::digest) != 0,
                  .digests = (message.flags & wire::Frame::digests) != 0,
                  .wantsDepth = (message.flags & wire::Frame::wantsDepth) != 0,
                  .tellsDepth = (message.flags & wire::Frame::tellsDepth) != 0,
                  .changes = {.bytes = {message.tail.begin(), message.tail.end()}}},
        .needed = std::move(message.needed),
        .released = std::move(message.released)};
    if (started_ && waiting_.empty()) {  // the usual case: straight through
        auto passed = pass(waiting);
        if (!passed) return tl::unexpected{std::move(passed).error()};
        if (*passed) return {};
    }
    waitingBytes_ += bytesOf(waiting.frame.changes);
    waiting_.emplace_back(std::move(waiting));
    return {};
}

Result<void> FrameGate::fit(const wire::Fit& message) {
    Fit event{.n = message.n, .changes = {.bytes = {message.tail.begin(), message.tail.end()}}};
    waitingBytes_ += bytesOf(event.changes);
    waiting_.emplace_back(std::move(event));
    return drain();
}

Result<void> FrameGate::swap(const wire::Swap& message) {
    waitingBytes_ += eventBytes;
    waiting_.emplace_back(Swap{.n = message.n});
    return drain();
}

Result<void> FrameGate::drain() {
    if (beginning_ && haveAll(beginning_->needed)) begin();
    while (started_ && !waiting_.empty()) {
        Waiting& front = waiting_.front();
        if (auto* frame = std::get_if<WaitingFrame>(&front)) {
            const std::size_t bytes = bytesOf(frame->frame.changes);
            auto passed = pass(*frame);
            if (!passed) return tl::unexpected{std::move(passed).error()};
            if (!*passed) return {};
            waitingBytes_ -= bytes;
        } else if (auto* fit = std::get_if<Fit>(&front)) {
            const std::size_t bytes = bytesOf(fit->changes);
            if (fit->n != lastFrame_)
                return fail(Errc::protocol,
                            fmt::format("Fit {} after frame {}", fit->n, lastFrame_));
            waitingBytes_ -= bytes;
            emit_(std::move(*fit), bytes);
        } else {
            const Swap swap = std::get<Swap>(front);
            if (swap.n > lastFrame_)
                return fail(Errc::protocol,
                            fmt::format("Swap {} after frame {}", swap.n, lastFrame_));
            waitingBytes_ -= eventBytes;
            if (swap.n >= first_) emit_(swap, eventBytes);
        }
        waiting_.pop_front();
    }
    return {};
}

Result<bool> FrameGate::pass(WaitingFrame& waiting) {
    Frame& frame = waiting.frame;
    if (frame.n != lastFrame_ + 1)
        return tl::unexpected{Error{.code = Errc::protocol,
                                    .what = fmt::format("Frame {} after frame {}, expected {}",
                                                        frame.n, lastFrame_, lastFrame_ + 1)}};
    if (!haveAll(waiting.needed)) return false;
    give(waiting.needed, frame.changes);
    for (const auto& release : waiting.released) {
        released_.insert(release.serial);
        const auto found = kept_.find(release.hash);
        if (found == kept_.end() || found->second.serial != release.serial) continue;
        keptBytes_ -= found->second.payload.size();
        kept_.erase(found);
    }
    lastFrame_ = frame.n;
    const std::size_t bytes = bytesOf(frame.changes);
    emit_(std::move(frame), bytes);
    return true;
}

}  // namespace gnomon::net
