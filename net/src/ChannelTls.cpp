// A channel's bytes on their way through TLS. One batch of queued parts still is one write, up to
// `slice` bytes: small parts share a record, large ones are sealed where they lie.
#include <fmt/format.h>

#include <algorithm>

#include "Channel.h"

namespace gnomon::net {

/// Opens what came until there is no more, or nobody wants it.
void Channel::pump() {
    if (pumping_) return;
    pumping_ = true;
    while (!closed_ && !reading_ && (!paused_ || finishing_)) {
        if (!openOne()) readSealed();
    }
    pumping_ = false;
}

/// False where more must come first.
bool Channel::openOne() {
    if (finishing_) return false;
    if (!tls_->established()) return shakeHands();
    auto count = tls_->read(roomForInput());
    if (!count) {
        Error why = std::move(count).error();
        why.what = remote_ + ": " + why.what;
        fail(std::move(why));
        return true;
    }
    if (*count == 0) return false;
    arrived(*count);
    return true;
}

bool Channel::shakeHands() {
    auto done = tls_->handshake();
    if (!done) {
        sendLastWords();  // tells the other side why
        fail(std::move(done).error().what);
        return true;
    }
    flushSealed();
    if (!*done) return false;
    input_.resize(inputBytes);
    if (receiver_ != nullptr) receiver_->secured(*this);
    return true;
}

void Channel::readSealed() {
    // TLS has used all that came before, so it may move.
    sealedInput_.resize(tls_->established() ? inputBytes : strangerBytes);
    reading_ = true;
    socket_.async_read_some(asio::buffer(sealedInput_.data(), sealedInput_.size()),
                            [self = shared_from_this()](error_code ec, std::size_t count) {
                                self->reading_ = false;
                                if (self->closed_) return;
                                if (ec) return self->ended(ec);
                                if (!self->finishing_)
                                    self->tls_->feed(std::span{self->sealedInput_}.first(count));
                                self->pump();
                            });
}

void Channel::flushSealed() {
    while (!closed_ && !writing_ && seal() && !tls_->output().empty()) {
        sealedOutput_.clear();
        sealedOutput_.swap(tls_->output());
        buffers_.assign(1, asio::const_buffer{sealedOutput_.data(), sealedOutput_.size()});
        write();
    }
}

/// Seals the next slice of what is queued. False where that failed.
bool Channel::seal() {
    if (!tls_->established()) return true;
    if (inFlight_.empty()) {
        inFlight_.swap(queue_);
        queuedBytes_ = 0;
        nextPart_ = partOffset_ = 0;
    }
    std::size_t left = slice;
    while (left > 0 && nextPart_ < inFlight_.size()) {
        const auto rest = inFlight_[nextPart_].bytes.subspan(partOffset_);
        const auto now = rest.first(std::min(rest.size(), left));
        if (!sealPart(now)) return false;
        left -= now.size();
        partOffset_ += now.size();
        if (now.size() < rest.size()) break;
        ++nextPart_;
        partOffset_ = 0;
    }
    if (nextPart_ == inFlight_.size()) inFlight_.clear();
    if (staged_.empty()) return true;
    const auto sealed = tls_->write(staged_);
    staged_.clear();
    if (!sealed) fail(sealed.error().what);
    return sealed.has_value();
}

/// Fills up the record that is begun; whole records are sealed in place.
bool Channel::sealPart(std::span<const std::byte> bytes) {
    constexpr std::size_t record = TlsSession::recordBytes;
    while (!bytes.empty()) {
        Result<void> sealed;
        if (staged_.empty() && bytes.size() >= record) {
            const auto whole = bytes.first(bytes.size() - bytes.size() % record);
            sealed = tls_->write(whole);
            bytes = bytes.subspan(whole.size());
        } else {
            const auto some = bytes.first(std::min(bytes.size(), record - staged_.size()));
            staged_.insert(staged_.end(), some.begin(), some.end());
            bytes = bytes.subspan(some.size());
            if (staged_.size() < record) continue;
            sealed = tls_->write(staged_);
            staged_.clear();
        }
        if (!sealed) {
            fail(sealed.error().what);
            return false;
        }
    }
    return true;
}

/// Whatever TLS still has to say, if the system takes it at once. What came meanwhile is read away:
/// to close over unread bytes is a reset, which overtakes the last words.
void Channel::sendLastWords() {
    if (writing_ || tls_->output().empty()) return;
    error_code ec;
    socket_.write_some(asio::buffer(tls_->output().data(), tls_->output().size()), ec);
    tls_->output().clear();
    std::array<std::byte, strangerBytes> unread{};
    for (int i = 0; i < 64 && !ec; ++i)
        socket_.read_some(asio::buffer(unread.data(), unread.size()), ec);
}

}  // namespace gnomon::net
