#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::net::test {

/// A group for lookups whose port nobody else here uses.
std::string lookupGroup();

/// Why no datagrams to groups go over loopback here; empty: they do.
std::string whyNoMulticast();

/// Hears what is sent to a group on loopback, and says what a test wants.
class FakeAnnouncer {
public:
    /// @param answer  to each datagram, on a thread of its own; empty: none
    using Answer = std::function<std::vector<std::byte>(std::span<const std::byte>)>;
    FakeAnnouncer(const std::string& group, Answer answer);
    ~FakeAnnouncer();
    FakeAnnouncer(const FakeAnnouncer&) = delete;
    FakeAnnouncer& operator=(const FakeAnnouncer&) = delete;
    int heard() const { return heard_; }

private:
    void run();

    int fd_ = -1;
    int stop_ = -1;
    Answer answer_;
    std::atomic<int> heard_{0};
    std::thread thread_;
};

/// Sends to a group on loopback, and waits for so many answers.
std::vector<std::vector<std::byte>> ask(const std::string& group,
                                        const std::vector<std::vector<std::byte>>& datagrams,
                                        std::size_t answers);

}  // namespace gnomon::net::test
