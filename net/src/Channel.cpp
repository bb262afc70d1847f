#include "Channel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "DeliveryRate.h"

namespace gnomon::net {
namespace {

constexpr int bulkBufferBytes = 4 << 20;  // the system may grant less

/// A view of buffers kept elsewhere: Asio copies its sequence at each step of a write.
struct BufferView {
    using value_type = asio::const_buffer;
    using const_iterator = const asio::const_buffer*;
    const_iterator first = nullptr, last = nullptr;
    const_iterator begin() const { return first; }
    const_iterator end() const { return last; }
};

std::uint32_t loadU32(const std::byte* from) noexcept {
    std::uint32_t value = 0;
    std::memcpy(&value, from, sizeof value);
    return value;
}

/// Whether these are the first bytes of a TLS alert or handshake. No message of ours begins so: as
/// its length that would be odd, and the type that follows does not exist.
bool speaksTls(std::span<const std::byte> bytes) noexcept {
    return bytes.size() >= 2 && (bytes[0] == std::byte{21} || bytes[0] == std::byte{22}) &&
           bytes[1] == std::byte{3};
}

}  // namespace

std::string nameOf(const tcp::socket& socket) {
    error_code ec;
    const auto end = socket.remote_endpoint(ec);
    return ec ? std::string{"(closed)"}
              : fmt::format("{}:{}", end.address().to_string(), end.port());
}

Channel::Channel(tcp::socket socket, Route route, Receiver& receiver,
                 std::unique_ptr<TlsSession> tls)
    : socket_{std::move(socket)},
      tls_{std::move(tls)},
      route_{route},
      receiver_{&receiver},
      remote_{nameOf(socket_)} {
    if (!tls_) input_.resize(inputBytes);
    error_code ignored;  // a socket that died already is found by the first read
    socket_.set_option(tcp::no_delay{true}, ignored);
    socket_.non_blocking(true, ignored);
    const auto end = socket_.remote_endpoint(ignored);
    toThisMachine_ = !ignored && isLoopback(end.address());
}

void Channel::read() {
    if (closed_ || reading_ || (paused_ && !finishing_)) return;
    if (tls_) return pump();
    reading_ = true;
    const auto room = roomForInput();
    socket_.async_read_some(asio::buffer(room.data(), room.size()),
                            [self = shared_from_this()](error_code ec, std::size_t count) {
                                self->reading_ = false;
                                if (self->closed_) return;
                                if (ec) return self->ended(ec);
                                self->arrived(count);
                            });
}

/// Where the next plain bytes go; never empty.
std::span<std::byte> Channel::roomForInput() {
    if (largeLength_ == 0) return std::span{input_}.subspan(end_);
    if (largeArrived_ == large_.size()) {
        // Doubles what has arrived: an announced length alone allocates little.
        const std::size_t more = std::max(keptBytes, largeArrived_);
        large_.resize(std::min(largeLength_, largeArrived_ + more));
    }
    return std::span{large_}.subspan(largeArrived_);
}

/// The other side closed, or the connection broke.
void Channel::ended(error_code ec) {
    if (!tls_ && speaksTls(std::span{input_}.first(end_).subspan(begin_)))
        return fail("it speaks TLS: a cluster key is needed on this side, too");
    if (!isSecured())
        return fail({.code = Errc::disconnected,  // of one that dies, too
                     .what = remote_ + ": it ended the connection within the TLS handshake: has it "
                                       "the cluster key?"});
    fail({.code = Errc::disconnected, .what = remote_, .cause = ec});
}

void Channel::arrived(std::size_t count) {
    lastHeard_ = SteadyClock::now();
    if (finishing_) {
        end_ = 0;
        return read();
    }
    if (largeLength_ > 0)
        largeArrived_ += count;
    else
        end_ += count;
    parse();
}

void Channel::parse() {
    if (parsing_) return;  // resume() from within a message
    parsing_ = true;
    while (!closed_ && !finishing_ && !paused_) {
        auto more = parseOne();
        if (!more) {
            fail(std::move(more).error());
            break;
        }
        if (!*more) break;
    }
    parsing_ = false;
    read();
}

/// Whether there may be another message in the input.
Result<bool> Channel::parseOne() {
    if (largeLength_ > 0) {
        if (largeArrived_ < largeLength_) return false;
        largeLength_ = 0;
        auto done = deliver(largeType_, large_);
        if (large_.size() > keptBytes) large_ = {};
        if (!done) return tl::unexpected{std::move(done).error()};
        return true;
    }
    const std::size_t have = end_ - begin_;
    const auto moveToFront = [&] {
        if (begin_ > 0) std::memmove(input_.data(), input_.data() + begin_, have);
        begin_ = 0;
        end_ = have;
    };
    if (have < 8) {
        moveToFront();
        return false;
    }
    const std::size_t length = loadU32(input_.data() + begin_);
    const std::uint32_t type = loadU32(input_.data() + begin_ + 4);
    const Limit limit = limitOf(route_, type);
    if (!limit.allowed && speaksTls(std::span{input_}.subspan(begin_)))
        return gnomon::fail(Errc::protocol,
                            remote_ + ": it speaks TLS: a cluster key is needed on this side, too");
    if (!limit.allowed)
        return gnomon::fail(Errc::protocol,
                            fmt::format("{}: message of type {} ({}) is not expected here", remote_,
                                        type, name(static_cast<MessageType>(type))));
    if (length > limit.bytes)
        return gnomon::fail(Errc::protocol,
                            fmt::format("{}: message {} of {} bytes, the limit is {}", remote_,
                                        name(static_cast<MessageType>(type)), length, limit.bytes));
    if (length + 8 > input_.size()) {
        const auto from = input_.begin() + static_cast<std::ptrdiff_t>(begin_ + 8);
        large_.assign(from, from + static_cast<std::ptrdiff_t>(have - 8));
        largeArrived_ = have - 8;
        largeLength_ = length;
        largeType_ = type;
        begin_ = end_ = 0;
        return largeArrived_ >= largeLength_;
    }
    if (have < length + 8) {
        moveToFront();
        return false;
    }
    const std::span<const std::byte> body{input_.data() + begin_ + 8, length};
    begin_ += length + 8;
    auto done = deliver(type, body);
    if (!done) return tl::unexpected{std::move(done).error()};
    return true;
}

Result<void> Channel::deliver(std::uint32_t type, std::span<const std::byte> body) {
    auto done = receiver_->received(*this, static_cast<MessageType>(type), body);
    if (!done) {
        Error why = std::move(done).error();
        why.what = remote_ + ": " + why.what;
        return tl::unexpected{std::move(why)};
    }
    return {};
}

std::optional<double> Channel::deliveryRate() const {
    if (closed_ || toThisMachine_) return {};
    // Asio has no const access to the descriptor.
    return deliveryRateOf(const_cast<tcp::socket&>(socket_).native_handle());
}

void Channel::expectBulk() {
    error_code ignored;
    socket_.set_option(tcp::socket::receive_buffer_size{bulkBufferBytes}, ignored);
}

void Channel::resume() {
    if (!paused_) return;
    paused_ = false;
    if (!reading_) parse();
}

void Channel::queue(Part part) {
    if (!isOpen() || part.bytes.empty()) return;
    queuedBytes_ += part.bytes.size();
    queue_.push_back(std::move(part));
    if ((writing_ || !isSecured()) && queuedBytes_ > maxQueuedBytes)
        fail({.code = Errc::limit,
              .what = fmt::format("{}: {} bytes wait to be sent, the limit is {}: it does not read",
                                  remote_, queuedBytes_, maxQueuedBytes)});
}

void Channel::flush() {
    if (closed_ || writing_) return;
    if (tls_) return flushSealed();
    if (queue_.empty()) return;
    inFlight_.clear();
    inFlight_.swap(queue_);
    queuedBytes_ = 0;
    buffers_.clear();
    for (const Part& part : inFlight_) buffers_.emplace_back(part.bytes.data(), part.bytes.size());
    write();
}

/// Hands buffers_ to the system: what it takes at once in one call, which is all of it but where
/// the other side is slow or there is much; the rest when it takes more.
void Channel::write() {
    ++writes_;
    error_code ec;
    std::size_t count =
        socket_.write_some(BufferView{buffers_.data(), buffers_.data() + buffers_.size()}, ec);
    if (ec == asio::error::would_block) {
        count = 0;
        ec.clear();
    }
    bytesSent_ += count;
    if (ec) return fail({.code = Errc::disconnected, .what = remote_, .cause = ec});
    auto rest = buffers_.begin();
    while (rest != buffers_.end() && count >= rest->size()) count -= (rest++)->size();
    if (rest == buffers_.end()) {
        if (!tellsDrained_) return;
        // Posted: whoever queues more at once would come here again from within.
        return asio::post(socket_.get_executor(), [self = shared_from_this()] {
            if (!self->closed_ && !self->writing_ && self->receiver_ != nullptr)
                self->receiver_->drained(*self);
        });
    }
    *rest += count;
    writing_ = true;
    const BufferView left{&*rest, buffers_.data() + buffers_.size()};
    asio::async_write(
        socket_, left, [self = shared_from_this()](error_code failed, std::size_t more) {
            self->writing_ = false;
            self->bytesSent_ += more;
            if (self->closed_) return;
            if (failed)
                return self->fail(
                    {.code = Errc::disconnected, .what = self->remote_, .cause = failed});
            self->flush();
            if (self->writing_ || self->closed_) return;
            if (self->finishing_) return self->end();
            if (self->receiver_ != nullptr) self->receiver_->drained(*self);
        });
}

void Channel::finish() {
    if (closed_ || finishing_) return;
    finishing_ = true;
    begin_ = end_ = 0;
    largeLength_ = 0;
    // The read in progress, if any, keeps its place in input_ or large_; both stay as they are.
    flush();
    if (!writing_) end();
    if (!parsing_) read();
}

void Channel::end() {
    if (tls_) {
        tls_->end();
        sendLastWords();
    }
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
}

void Channel::fail(Error why) {
    if (closed_) return;
    closed_ = true;
    error_code ignored;
    socket_.close(ignored);
    // Posted: a queue() in a loop over channels must not change the loop's container.
    asio::post(socket_.get_executor(), [self = shared_from_this(), why = std::move(why)]() mutable {
        if (self->receiver_ != nullptr) self->receiver_->closed(*self, std::move(why));
    });
}

void Channel::fail(std::string why) {
    fail({.code = Errc::protocol, .what = remote_ + ": " + std::move(why)});
}

void Channel::close() {
    receiver_ = nullptr;
    if (closed_) return;
    closed_ = true;
    error_code ignored;
    socket_.close(ignored);
}

}  // namespace gnomon::net
