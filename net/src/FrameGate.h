#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/Payload.h>
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerEvent.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <unordered_map>
#include <variant>
#include <vector>

namespace gnomon::net {

/// Puts a session's two streams together: snapshot first, then frames, fits and swaps in the order
/// they were sent, each frame held back until every payload it names has arrived. Knows no sockets.
///
/// Payloads are kept until a frame releases them. All errors are Errc::protocol or Errc::limit and
/// end the session.
class FrameGate {
public:
    /// @param bytes  what the event holds in memory, payloads not counted
    using Emit = std::function<void(ServerEvent event, std::size_t bytes)>;

    FrameGate(std::uint64_t payloadBudget, Emit emit)
        : budget_{payloadBudget}, emit_{std::move(emit)} {}

    Result<void> payload(const wire::Payload& part);
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
    struct Kept {
        field::Payload payload = {};
        std::uint64_t serial = 0;
    };
    struct WaitingFrame {
        Frame frame = {};
        std::vector<wire::PayloadName> needed = {};
        std::vector<wire::PayloadRelease> released = {};
    };
    using Waiting = std::variant<WaitingFrame, Fit, Swap>;

    Result<void> drain();
    /// Hands it on and returns true, or false where payloads are missing.
    Result<bool> pass(WaitingFrame& waiting);

    const std::uint64_t budget_;
    Emit emit_;
    std::optional<Upload> upload_;
    std::unordered_map<field::Hash128, Kept> kept_;
    std::uint64_t keptBytes_ = 0;
    std::vector<std::byte> snapshot_;
    bool started_ = false;         // the snapshot was handed on
    std::uint64_t first_ = 0;      // the snapshot's frame
    std::uint64_t lastFrame_ = 0;  // handed on
    std::deque<Waiting> waiting_;
    std::size_t waitingBytes_ = 0;
};

}  // namespace gnomon::net
