#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <queue>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "Namespaces.h"

namespace gnomon::faults {

/// What happens to the packets of a link, in each direction.
struct Weather {
    double loss = 0.0;                    ///< share of the packets
    std::chrono::microseconds delay{0};   ///< of every packet
    std::chrono::microseconds jitter{0};  ///< up to that much more: packets overtake each other
};

/// A link between two namespaces, a TUN device at each end and a relay in between, which loses,
/// delays and reorders IP packets. The same seed decides about the same packets.
class TunLink {
public:
    /// Addresses with the length of their prefix, "10.9.2.1/24".
    TunLink(const Namespace& one, const std::string& oneAddress, const Namespace& other,
            const std::string& otherAddress, const Weather& weather = {});
    ~TunLink();
    TunLink(const TunLink&) = delete;
    TunLink& operator=(const TunLink&) = delete;

    /// A cut cable: no packet passes, and nobody is told.
    void cut() { cut_ = true; }
    void mend() { cut_ = false; }
    std::uint64_t packets() const { return packets_; }
    std::uint64_t lost() const { return lost_; }
    /// Packets that went out before one that came in earlier.
    std::uint64_t overtook() const { return overtook_; }

private:
    using Clock = std::chrono::steady_clock;
    struct Packet {
        Clock::time_point due = {};
        std::uint64_t number = 0;
        int to = -1;
        std::vector<char> bytes = {};
        friend bool operator<(const Packet& a, const Packet& b) {
            return a.due != b.due ? a.due > b.due : a.number > b.number;
        }
    };

    void relay();
    void take(int from, int to);
    void deliver(Clock::time_point now);

    const Weather weather_;
    std::array<int, 2> ends_{-1, -1};
    int wake_ = -1;
    std::atomic<bool> cut_{false};
    std::atomic<bool> ending_{false};
    std::atomic<std::uint64_t> packets_{0}, lost_{0}, overtook_{0};

    // The relay's.
    std::mt19937 random_{20250301};
    std::priority_queue<Packet> waiting_;
    std::array<std::uint64_t, 2> newest_{0, 0};  // number sent, by end
    std::thread thread_;
};

}  // namespace gnomon::faults
