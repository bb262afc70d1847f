#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>

#include "Datagrams.h"

namespace gnomon::net {

/// Asks a group who has a name, at once and then again at growing intervals (100 ms to 2 s).
class Finder {
public:
    /// An answer. Anybody may have given it.
    struct Heard {
        std::string host = {};
        std::uint16_t port = 0;
        std::uint64_t instance = 0;
        std::uint32_t version = 0;
        SteadyClock::duration after = {};  ///< from the latest question
    };
    using Hear = std::function<void(const Heard&)>;

    /// @param group     see parseLookupGroup() @throws Failure Errc::config
    /// @param anywhere  false: on this machine only, since without a key nothing leaves it
    /// @param report    what is wrong with answers or with asking; for people
    Finder(asio::io_context& io, std::string name, const std::string& group, bool anywhere,
           std::function<void(const std::string&)> report);

    /// Begins anew. @p hear is called for each answer, also several times for one server.
    void start(Hear hear);
    /// Somebody answered: asks no more, and hears others for another second.
    void settle();
    void stop();
    /// Hears answers.
    bool listens() const noexcept { return answers_ != nullptr; }

private:
    void ask();
    void take(std::span<const std::byte> datagram, const udp::endpoint& from);
    void report(const std::string& what);

    asio::io_context& io_;
    const std::string name_;
    udp::endpoint group_ = {};
    const bool anywhere_;
    const std::function<void(const std::string&)> report_;
    std::set<std::string> reported_ = {};
    bool malformedSaid_ = false;
    Hear hear_ = {};
    std::vector<std::byte> question_ = {};
    std::uint64_t token_ = 0;
    TimePoint askedAt_ = {};
    Milliseconds interval_ = {};
    Timer timer_;
    std::unique_ptr<Datagrams> answers_ = {};
};

}  // namespace gnomon::net
