#include "Announcer.h"

#include <fmt/format.h>
#include <gnomon/net/Lookup.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "Interfaces.h"
#include "Token.h"

namespace gnomon::net {
namespace {

/// Interfaces come and go: a server may be up before its network is.
constexpr std::chrono::seconds joinAgain{3};

Failure cannotAnnounce(const AnnouncerOptions& options, const std::string& why,
                       error_code ec = {}) {
    return Failure{{.code = Errc::config,
                    .what = fmt::format("server \"{}\": cannot be looked up on {}{}", options.name,
                                        options.group, why.empty() ? why : ": " + why),
                    .cause = ec}};
}

asio::ip::address_v4 v4Of(const AnnouncerOptions& options) {
    const auto& address = options.listening;
    if (address.is_v4()) return address.to_v4();
    if (address.to_v6().is_unspecified()) return {};
    if (address.to_v6().is_v4_mapped())
        return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    throw cannotAnnounce(options, "that is IPv4, and it listens on " + address.to_string());
}

}  // namespace

Announcer::Announcer(asio::io_context& io, AnnouncerOptions options)
    : options_{std::move(options)},
      listening_{v4Of(options_)},
      responder_{options_.name, options_.port, randomToken()},
      joinTimer_{io},
      answers_{io} {
    const auto group = orThrow(parseLookupGroup(options_.group));
    if (options_.name.size() > maxLookupName)
        throw cannotAnnounce(options_, fmt::format("its name has {} bytes, at most {} can be asked "
                                                   "for",
                                                   options_.name.size(), maxLookupName));
    group_ = asio::ip::make_address_v4(group.address);
    error_code ec;
    udp::socket listener{io};
    if (listener.open(udp::v4(), ec)) throw cannotAnnounce(options_, {}, ec);
    listener.set_option(udp::socket::reuse_address{true}, ec);
    // From the interfaces joined here alone, not those that other programs have joined.
    const int off = 0;
    ::setsockopt(listener.native_handle(), IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off);
    // Bound to the group: what is sent to this machine alone does not come here.
    if (listener.bind({group_, group.port}, ec)) throw cannotAnnounce(options_, {}, ec);
    if (answers_.open(udp::v4(), ec) || answers_.bind({listening_, 0}, ec) ||
        answers_.non_blocking(true, ec))
        throw cannotAnnounce(options_, {}, ec);
    lookups_ =
        std::make_unique<Datagrams>(io, std::move(listener),
                                    [this](std::span<const std::byte> datagram,
                                           const udp::endpoint& from) { take(datagram, from); });
    join();
}

void Announcer::join() {
    for (const Interface& interface : interfacesOf(listening_)) {
        error_code ec;
        lookups_->socket().set_option(asio::ip::multicast::join_group{group_, interface.address},
                                      ec);
        if (!ec || ec == asio::error::address_in_use) continue;
        if (notJoined_.insert(interface.name).second && options_.report)
            options_.report(
                fmt::format("cannot be looked up through {}: {}", interface.name, ec.message()));
    }
    joinTimer_.after(joinAgain, [this] { join(); });
}

void Announcer::take(std::span<const std::byte> datagram, const udp::endpoint& from) {
    if (listening_.is_loopback() && !isLoopback(from.address())) return;
    const auto answer = responder_.answer(datagram, SteadyClock::now());
    if (!answer) return malformed(from, answer.error().text());
    error_code ignored;  // who asked asks again
    if (!answer->empty()) answers_.send_to(asio::buffer(*answer), from, 0, ignored);
}

/// Said at the first, the tenth, the hundredth ...
void Announcer::malformed(const udp::endpoint& from, const std::string& why) {
    ++malformed_;
    auto rest = malformed_;
    while (rest % 10 == 0) rest /= 10;
    if (rest != 1 || !options_.report) return;
    options_.report(fmt::format("{} datagram{} dropped, the last from {}:{}: {}", malformed_,
                                malformed_ == 1 ? "" : "s", from.address().to_string(), from.port(),
                                why));
}

}  // namespace gnomon::net
