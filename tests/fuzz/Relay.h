#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace gnomon::fuzz {

/// Stands between a client and its server on this machine, passes on what they say, and keeps it.
class Relay {
public:
    struct Piece {
        std::size_t connection = 0;  ///< in the order they were made: control, bulk
        bool toServer = false;
        std::vector<std::byte> bytes = {};
    };

    explicit Relay(std::uint16_t server);
    ~Relay();
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

    std::uint16_t port() const noexcept { return port_; }
    /// Ends it; all that was said, in its order.
    std::vector<Piece> end();

private:
    struct Link {
        int client = -1;
        int server = -1;
    };
    void run();
    void pass(std::size_t connection, bool toServer);

    const std::uint16_t server_;
    std::uint16_t port_ = 0;
    int listener_ = -1;
    int stop_ = -1;
    std::vector<Link> links_;
    std::vector<Piece> pieces_;
    std::thread thread_;
};

}  // namespace gnomon::fuzz
