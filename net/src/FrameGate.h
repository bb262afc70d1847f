#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/Payload.h>
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerEvent.h>

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "SerialSet.h"

namespace gnomon::net {

/// Told of uploads as they come, to pass them on.
class UploadWatch {
public:
    virtual ~UploadWatch() = default;
    /// More of it has come, maybe the first part.
    virtual void arriving(const wire::Payload& part) = 0;
    /// All of it; frames that wait for it have not been handed on yet.
    virtual void arrived(std::uint64_t serial, const field::Payload& payload) = 0;
};

/// Puts a session's streams together: snapshot first, then frames, fits and swaps in the order they
/// were sent, each held back until every payload it names has arrived. Knows no sockets.
///
/// Payloads are kept until a frame releases them. All errors are Errc::protocol or Errc::limit and
/// end the session.
class FrameGate {
public:
    /// @param bytes  what the event holds in memory, payloads not counted
    using Emit = std::function<void(ServerEvent event, std::size_t bytes)>;
    /// Where payloads come from. The parts of one come from one source; the same may come from
    /// both.
    enum class Source : std::uint8_t { client, relay };

    FrameGate(std::uint64_t payloadBudget, Emit emit)
        : budget_{payloadBudget}, emit_{std::move(emit)} {}

    /// @param watch  nullptr: nobody; outlives the gate
    void setWatch(UploadWatch* watch) noexcept { watch_ = watch; }
    Result<void> payload(const wire::Payload& part, Source source = Source::client);
    /// What came of a payload, but not to its end, is forgotten.
    void sourceEnded(Source source) { upload(source).reset(); }
    /// What there is of an upload that has not come to its end; empty where there is nothing.
    std::span<const std::byte> unfinished(std::uint64_t serial) const noexcept;
    struct Kept {
        field::Payload payload = {};
        std::uint64_t serial = 0;
    };
    const std::unordered_map<field::Hash128, Kept>& kept() const noexcept { return kept_; }
    /// Of payloads and snapshot, since the session began.
    std::uint64_t bytesArrived() const noexcept { return bytesArrived_; }

    Result<void> snapshot(const wire::Snapshot& part);
    Result<void> frame(wire::Frame message);
    Result<void> fit(const wire::Fit& message);
    Result<void> swap(const wire::Swap& message);

    /// Bytes of frames that wait here.
    std::size_t waitingBytes() const noexcept { return waitingBytes_; }

private:
    struct Upload {
        field::Hash128 hash = {};
        std::uint64_t serial = 0;
        std::uint64_t total = 0;
        std::vector<std::byte> bytes = {};
    };
    struct WaitingSnapshot {
        Snapshot snapshot = {};
        std::vector<wire::PayloadName> needed = {};
    };
    struct WaitingFrame {
        Frame frame = {};
        std::vector<wire::PayloadName> needed = {};
        std::vector<wire::PayloadRelease> released = {};
    };
    using Waiting = std::variant<WaitingFrame, Fit, Swap>;

    std::optional<Upload>& upload(Source source) noexcept {
        return uploads_[static_cast<std::size_t>(source)];
    }
    Result<void> keep(Upload whole);
    bool haveAll(const std::vector<wire::PayloadName>& needed) const;
    void give(const std::vector<wire::PayloadName>& needed, field::ChangeList& changes) const;
    void begin();
    Result<void> drain();
    /// Hands it on and returns true, or false where payloads are missing.
    Result<bool> pass(WaitingFrame& waiting);

    const std::uint64_t budget_;
    Emit emit_;
    UploadWatch* watch_ = nullptr;
    std::array<std::optional<Upload>, 2> uploads_;  // by source
    std::unordered_map<field::Hash128, Kept> kept_;
    std::uint64_t keptBytes_ = 0, bytesArrived_ = 0;
    SerialSet released_;  // by frames: from another source such an upload may still come
    std::vector<std::byte> snapshot_;
    std::optional<WaitingSnapshot> beginning_;  // it is whole; payloads may be missing
    bool started_ = false;                      // the snapshot was handed on
    std::uint64_t first_ = 0;                   // the snapshot's frame
    std::uint64_t lastFrame_ = 0;               // handed on
    std::deque<Waiting> waiting_;
    std::size_t waitingBytes_ = 0;
};

}  // namespace gnomon::net
