#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/net/MessageType.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "Asio.h"
#include "Tls.h"

namespace gnomon::net {

class Channel;

/// Bytes to be sent that stay alive until they are: encoded once, queued to any number of channels.
struct Part {
    std::shared_ptr<const void> owner = {};
    std::span<const std::byte> bytes = {};

    static Part of(std::vector<std::byte> bytes) {
        auto shared = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
        const std::span<const std::byte> view{*shared};
        return {.owner = std::move(shared), .bytes = view};
    }
};

/// Who owns channels and hears from them. Outlives them or closes them.
class Receiver {
public:
    virtual ~Receiver() = default;
    /// A whole message; @p body is valid during the call. An error closes the channel.
    virtual Result<void> received(Channel& from, MessageType type,
                                  std::span<const std::byte> body) = 0;
    /// Both sides have proved the cluster key. Not called for a channel without TLS.
    virtual void secured(Channel& /*channel*/) {}
    /// Everything queued was handed to the operating system, after it had to wait (see
    /// Channel::tellDrained).
    virtual void drained(Channel& /*channel*/) {}
    /// The channel closed by itself. Called once, never from within another call of the channel,
    /// and never after close().
    virtual void closed(Channel& channel, Error why) = 0;
};

/// One TCP connection that carries messages: u32 body length, u32 type, body, little-endian.
///
/// Used by one thread at a time. Messages are checked against limitOf(route, type) before any of
/// their bytes is kept; memory grows with the bytes that arrived, not with the length announced.
///
/// With a TlsSession all of it is sealed, and before the other side has proved the cluster key
/// nothing of it is looked at, and no more than a few KiB are kept.
class Channel : public std::enable_shared_from_this<Channel> {
public:
    /// Queued but unsent bytes beyond which the other side counts as not reading; the write in
    /// progress does not count, so that one large message passes.
    static constexpr std::size_t maxQueuedBytes = std::size_t{64} << 20U;

    Channel(tcp::socket socket, Route route, Receiver& receiver,
            std::unique_ptr<TlsSession> tls = nullptr);

    void start() { parse(); }
    /// False while the TLS handshake goes on; what is queued waits for its end.
    bool isSecured() const noexcept { return !tls_ || tls_->established(); }
    /// What may come from now on.
    void setRoute(Route route) noexcept { route_ = route; }
    /// Large messages will come. The system's own choice of buffer holds one or two of loopback's
    /// 64 KiB segments, and then each chunk waits for a delayed acknowledgement.
    void expectBulk();

    void queue(Part part);
    /// Starts sending what is queued, in one write; while a write runs, the next one takes it all.
    void flush();
    void send(Part part) {
        queue(std::move(part));
        flush();
    }

    /// Large messages will be sent a piece at a time: drained() is called after each, also when the
    /// system took it at once.
    void tellDrained() noexcept { tellsDrained_ = true; }

    void pause() noexcept { paused_ = true; }
    void resume();

    /// Closes at once, silently.
    void close();
    /// Sends what is queued and the end of the stream, then ignores what comes until the other
    /// side closes too. The owner bounds the time.
    void finish();

    bool isOpen() const noexcept { return !closed_ && !finishing_; }
    bool isIdle() const noexcept { return !writing_ && queue_.empty(); }
    const std::string& remote() const noexcept { return remote_; }
    TimePoint lastHeard() const noexcept { return lastHeard_; }
    /// Bytes a second that lately reached another machine, as the system measured it while there
    /// was always more to send; nothing where it has not.
    std::optional<double> deliveryRate() const;
    std::uint64_t bytesSent() const noexcept { return bytesSent_; }
    std::uint64_t writes() const noexcept { return writes_; }

private:
    static constexpr std::size_t inputBytes = std::size_t{64} << 10U;
    /// Enough for every message of a bulk connection, which come one after the other.
    static constexpr std::size_t keptBytes = std::size_t{1} << 20U;
    /// Read at a time before the other side has proved the key.
    static constexpr std::size_t strangerBytes = std::size_t{4} << 10U;
    /// Sealed at a time: enough for one write of whatever a frame usually is.
    static constexpr std::size_t slice = std::size_t{256} << 10U;

    void read();
    std::span<std::byte> roomForInput();
    void arrived(std::size_t count);
    void ended(error_code ec);
    void parse();
    Result<bool> parseOne();
    Result<void> deliver(std::uint32_t type, std::span<const std::byte> body);
    void write();
    void fail(Error why);
    void fail(std::string why);
    void end();

    // ChannelTls.cpp: the same with a TlsSession in between.
    void pump();
    bool openOne();
    bool shakeHands();
    void readSealed();
    void flushSealed();
    bool seal();
    bool sealPart(std::span<const std::byte> bytes);
    void sendLastWords();

    tcp::socket socket_;
    const std::unique_ptr<TlsSession> tls_;  // null: in the clear
    Route route_;
    Receiver* receiver_;
    std::string remote_;
    bool toThisMachine_ = false;

    std::vector<std::byte> input_;
    std::size_t begin_ = 0, end_ = 0;  // unread part of input_
    std::vector<std::byte> large_;     // a body that does not fit into input_
    std::size_t largeArrived_ = 0, largeLength_ = 0;
    std::uint32_t largeType_ = 0;

    std::vector<std::byte> sealedInput_, sealedOutput_, staged_;
    std::size_t nextPart_ = 0, partOffset_ = 0;  // of inFlight_, to be sealed next

    std::vector<Part> queue_, inFlight_;
    std::vector<asio::const_buffer> buffers_;
    std::size_t queuedBytes_ = 0;

    bool reading_ = false, writing_ = false, paused_ = false, tellsDrained_ = false;
    bool parsing_ = false, pumping_ = false, finishing_ = false, closed_ = false;
    TimePoint lastHeard_ = SteadyClock::now();
    std::uint64_t bytesSent_ = 0, writes_ = 0;
};

}  // namespace gnomon::net
