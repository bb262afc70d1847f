#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::net::test {

/// A TCP connection without any manners, to 127.0.0.1.
class RawSocket {
public:
    explicit RawSocket(std::uint16_t port);
    ~RawSocket();
    RawSocket(RawSocket&& other) noexcept : fd_{std::exchange(other.fd_, -1)} {}
    RawSocket& operator=(RawSocket&&) = delete;
    RawSocket(const RawSocket&) = delete;
    RawSocket& operator=(const RawSocket&) = delete;

    void send(std::span<const std::byte> bytes);
    /// Everything until the other side closes; @p closed false where it had not after 30 s.
    std::vector<std::byte> readAll(bool* closed);
    /// Until at least so many bytes came.
    std::vector<std::byte> read(std::size_t atLeast);
    /// Closes with a reset, as a killed program with unread input does.
    void reset();

private:
    friend class DeafListener;
    struct Adopt {
        int fd = -1;
    };
    explicit RawSocket(Adopt adopted) : fd_{adopted.fd} {}

    int fd_ = -1;
};

/// A port where connections are taken and nothing is said, but for what a test says itself.
class DeafListener {
public:
    DeafListener();
    ~DeafListener();
    DeafListener(const DeafListener&) = delete;
    DeafListener& operator=(const DeafListener&) = delete;
    std::uint16_t port() const { return port_; }
    RawSocket accept();

private:
    int fd_ = -1;
    std::uint16_t port_ = 0;
};

}  // namespace gnomon::net::test
