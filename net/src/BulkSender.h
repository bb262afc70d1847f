#pragma once

#include <cstdint>
#include <deque>
#include <functional>

#include "Channel.h"
#include "Packer.h"

namespace gnomon::net {

/// Something large that goes out in chunks.
struct BulkItem {
    Part whole = {};
    /// Length, type and fields of the chunk at @p offset that carries @p chunk.
    std::function<std::vector<std::byte>(std::uint64_t offset, std::span<const std::byte> chunk)>
        head = {};
};

/// Feeds a bulk channel one chunk at a time, so that what waits here costs no second copy.
class BulkSender {
public:
    /// @param packer  outlives this
    explicit BulkSender(Packer& packer) noexcept : packer_{packer} {}

    void attach(std::shared_ptr<Channel> channel) {
        channel_ = std::move(channel);
        channel_->tellDrained();
        pump();
    }
    void add(BulkItem item) {
        waitingBytes_ += item.whole.bytes.size();
        items_.push_back(std::move(item));
        pump();
    }
    /// To be called when the channel drained.
    void drained() {
        lastProgress_ = SteadyClock::now();
        pump();
    }
    void clear() {
        channel_.reset();
        items_.clear();
        offset_ = 0;
        waitingBytes_ = 0;
    }

    /// Everything added was handed to the operating system.
    bool idle() const noexcept { return items_.empty() && (!channel_ || channel_->isIdle()); }
    std::uint64_t waitingBytes() const noexcept { return waitingBytes_; }
    TimePoint lastProgress() const noexcept { return lastProgress_; }

private:
    void pump() {
        if (!channel_ || items_.empty() || !channel_->isIdle()) return;
        const BulkItem& item = items_.front();
        const auto rest = item.whole.bytes.subspan(offset_);
        const auto chunk = rest.first(std::min(rest.size(), chunkBytes));
        packer_.queue(*channel_, item.head(offset_, chunk),
                      {.owner = item.whole.owner, .bytes = chunk});
        offset_ += chunk.size();
        waitingBytes_ -= chunk.size();
        if (offset_ == item.whole.bytes.size()) {
            items_.pop_front();
            offset_ = 0;
        }
        lastProgress_ = SteadyClock::now();
        channel_->flush();
    }

    Packer& packer_;
    std::shared_ptr<Channel> channel_;
    std::deque<BulkItem> items_;
    std::size_t offset_ = 0;
    std::uint64_t waitingBytes_ = 0;
    TimePoint lastProgress_ = {};
};

}  // namespace gnomon::net
