#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::net {

/// a - b of clocks that may be anything: wraps round, as a clock does.
inline std::int64_t clockDifference(std::int64_t a, std::int64_t b) noexcept {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

/// How far a server's steady clock is ahead of ours, from Ping round trips.
///
/// Of the last 16 trips the shortest counts: whatever delays a trip makes it longer, and the error
/// of the offset is at most half the trip. David Mills. Improved Algorithms for Synchronizing
/// Computer Network Clocks. 1995. (The minimum filter only; drift over 16 pings is negligible.)
class ClockFilter {
public:
    /// All in nanoseconds: our clock at sending and receiving, the server's (which may say
    /// anything) in between.
    /// @pre 0 <= sent
    void add(std::int64_t sent, std::int64_t server, std::int64_t received) {
        const std::int64_t trip = std::max<std::int64_t>(received - sent, 0);
        samples_[count_ % samples_.size()] = {trip, clockDifference(server, sent + trip / 2)};
        ++count_;
    }
    bool known() const noexcept { return count_ > 0; }
    /// Server's clock minus ours, nanoseconds.
    std::optional<std::int64_t> offset() const noexcept {
        const Sample* best = shortest();
        return best == nullptr ? std::optional<std::int64_t>{} : best->offset;
    }
    /// Nanoseconds; the shortest of the last 16.
    std::optional<std::int64_t> trip() const noexcept {
        const Sample* best = shortest();
        return best == nullptr ? std::optional<std::int64_t>{} : best->trip;
    }

private:
    struct Sample {
        std::int64_t trip = 0;
        std::int64_t offset = 0;
    };
    const Sample* shortest() const noexcept {
        const std::size_t used = std::min(count_, samples_.size());
        if (used == 0) return nullptr;
        return &*std::min_element(samples_.begin(),
                                  samples_.begin() + static_cast<std::ptrdiff_t>(used),
                                  [](const Sample& a, const Sample& b) { return a.trip < b.trip; });
    }

    std::array<Sample, 16> samples_{};
    std::size_t count_ = 0;
};

}  // namespace gnomon::net
