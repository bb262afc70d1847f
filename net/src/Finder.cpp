#include "Finder.h"

#include <fmt/format.h>
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/Lookup.h>
#include <gnomon/net/ServerMessages.h>

#include <algorithm>

#include "Interfaces.h"
#include "Token.h"

namespace gnomon::net {
namespace {

constexpr Milliseconds firstInterval{100};
constexpr Milliseconds lastInterval{2000};
/// How long others of the name are heard after the first one.
constexpr Milliseconds settling{1000};

}  // namespace

Finder::Finder(asio::io_context& io, std::string name, const std::string& group, bool anywhere,
               std::function<void(const std::string&)> report)
    : io_{io}, name_{std::move(name)}, anywhere_{anywhere}, report_{std::move(report)}, timer_{io} {
    const auto parsed = orThrow(parseLookupGroup(group));
    group_ = {asio::ip::make_address_v4(parsed.address), parsed.port};
}

void Finder::start(Hear hear) {
    stop();
    hear_ = std::move(hear);
    interval_ = firstInterval;
    token_ = randomToken();
    question_ = datagram(wire::Lookup::padded(token_, name_));
    ask();
}

void Finder::ask() {
    timer_.after(interval_, [this] { ask(); });
    interval_ = std::min(interval_ * 2, lastInterval);
    error_code ec;
    if (!answers_) {
        udp::socket socket{io_};
        const auto any = anywhere_ ? asio::ip::address_v4::any() : asio::ip::address_v4::loopback();
        if (socket.open(udp::v4(), ec) || socket.bind({any, 0}, ec))
            return report("cannot ask: " + ec.message());
        answers_ = std::make_unique<Datagrams>(
            io_, std::move(socket),
            [this](std::span<const std::byte> datagram, const udp::endpoint& from) {
                take(datagram, from);
            });
    }
    askedAt_ = SteadyClock::now();
    const auto through =
        interfacesOf(anywhere_ ? asio::ip::address_v4::any() : asio::ip::address_v4::loopback());
    for (const Interface& interface : through) {
        answers_->socket().set_option(asio::ip::multicast::outbound_interface{interface.address},
                                      ec);
        if (!ec) answers_->socket().send_to(asio::buffer(question_), group_, 0, ec);
        if (ec) report(fmt::format("cannot ask through {}: {}", interface.name, ec.message()));
    }
    if (through.empty()) report("cannot ask: no network interface is up");
}

void Finder::take(std::span<const std::byte> datagram, const udp::endpoint& from) {
    if (!anywhere_ && !isLoopback(from.address())) return;
    const auto answer = decodeDatagram<wire::Announcement>(Route::toClientLookup, datagram);
    if (!answer) {
        if (std::exchange(malformedSaid_, true)) return;
        return report(fmt::format("dropped what {}:{} answered: {}", from.address().to_string(),
                                  from.port(), answer.error().text()));
    }
    if (answer->token != token_ || answer->server != name_) return;
    const auto hear = hear_;  // it may begin anew
    hear({.host = from.address().to_string(),
          .port = answer->port,
          .instance = answer->instance,
          .version = answer->version,
          .after = SteadyClock::now() - askedAt_});
}

void Finder::settle() {
    timer_.after(settling, [this] { stop(); });
}

void Finder::stop() {
    timer_.cancel();
    answers_.reset();
}

/// Each trouble once: there are as many as interfaces.
void Finder::report(const std::string& what) {
    if (reported_.insert(what).second && report_) report_(what);
}

}  // namespace gnomon::net
