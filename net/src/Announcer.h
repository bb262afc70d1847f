#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>

#include "Datagrams.h"
#include "Responder.h"

namespace gnomon::net {

struct AnnouncerOptions {
    std::string name = {};
    asio::ip::address listening = {};  ///< of the server; only there it is to be found
    std::uint16_t port = 0;            ///< the server's
    std::string group = {};            ///< see parseLookupGroup()
    std::function<void(const std::string&)> report = {};  ///< for people
};

/// Answers those who look for a server's name, on the interfaces that it listens on: on loopback
/// only, unless there is a key. Says where it is and nothing that anybody has to be kept from
/// knowing; who connects then must prove the key as ever.
class Announcer {
public:
    /// @throws Failure Errc::config: no such group, a name too long for it, a taken port, or a
    ///         server that cannot be reached by IPv4
    Announcer(asio::io_context& io, AnnouncerOptions options);

private:
    void join();
    void take(std::span<const std::byte> datagram, const udp::endpoint& from);
    void malformed(const udp::endpoint& from, const std::string& why);

    const AnnouncerOptions options_;
    const asio::ip::address_v4 listening_;
    asio::ip::address_v4 group_ = {};
    Responder responder_;
    std::uint64_t malformed_ = 0;
    std::set<std::string> notJoined_ = {};  // interfaces, that it was said of
    Timer joinTimer_;
    // Answers come from the address that the server listens on, which is the one they tell.
    udp::socket answers_;
    std::unique_ptr<Datagrams> lookups_ = {};
};

}  // namespace gnomon::net
