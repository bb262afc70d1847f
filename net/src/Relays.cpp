#include "Relays.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::net {

Relays::Relays(asio::io_context& io, std::shared_ptr<const TlsContext> tls, const FrameGate& gate,
               Lost lost)
    : io_{io}, tls_{std::move(tls)}, gate_{gate}, lost_{std::move(lost)} {}

Relays::~Relays() {
    for (const Child& child : children_)
        if (child.channel) child.channel->close();
}

std::list<Relays::Child>::iterator Relays::childOf(std::uint64_t token) {
    return std::find_if(children_.begin(), children_.end(),
                        [&](const Child& child) { return child.relay.token == token; });
}

void Relays::add(wire::Relay relay) {
    remove(relay.token);
    Child& child = children_.emplace_back();
    child.wanted.insert(relay.uploads.begin(), relay.uploads.end());
    // In the order of their serials, which is that of their first use.
    std::vector<Item> here;
    for (const auto& [hash, kept] : gate_.kept())
        if (child.wanted.contains(kept.serial) || kept.serial > relay.after)
            here.push_back({.hash = hash,
                            .serial = kept.serial,
                            .total = kept.payload.size(),
                            .whole = kept.payload});
    std::sort(here.begin(), here.end(),
              [](const Item& a, const Item& b) { return a.serial < b.serial; });
    for (Item& item : here) {
        child.wanted.erase(item.serial);
        child.begun.insert(item.serial);
        child.items.push_back(std::move(item));
    }
    child.relay = std::move(relay);
    child.dialer = std::make_unique<Dialer>(io_, tls_ != nullptr);
    const auto token = child.relay.token;
    // Posted: to fail at once is to be told of later, too.
    asio::post(io_, [this, alive = std::weak_ptr{alive_}, token] {
        if (alive.expired()) return;
        const auto at = childOf(token);
        if (at == children_.end()) return;
        const std::string label = fmt::format("{}:{}", at->relay.host, at->relay.port);
        at->dialer->dial(at->relay.host, at->relay.port, label,
                         [this, token](Result<tcp::socket> socket) {
                             if (!socket) return drop(token, socket.error().text());
                             connected(*childOf(token), *std::move(socket));
                         });
    });
}

void Relays::connected(Child& child, tcp::socket socket) {
    child.channel = std::make_shared<Channel>(std::move(socket), Route::toRelay, *this,
                                              tls_ ? std::make_unique<TlsSession>(tls_) : nullptr);
    child.channel->tellDrained();
    child.channel->start();
    child.channel->send(
        Part::of(packet(wire::ClientHello{.role = wire::Role::relay, .token = child.relay.token})));
}

void Relays::remove(std::uint64_t token) {
    const auto at = childOf(token);
    if (at == children_.end()) return;
    if (at->channel) at->channel->close();
    children_.erase(at);
}

void Relays::drop(std::uint64_t token, const std::string& why) {
    remove(token);
    lost_(token, why);
}

void Relays::arriving(const wire::Payload& part) {
    if (part.offset == 0) enqueue({.hash = part.hash, .serial = part.serial, .total = part.total});
    for (Child& child : children_) pump(child);
}

void Relays::arrived(std::uint64_t serial, const field::Payload& payload) {
    // One that came in a single part begins here.
    enqueue({.hash = payload.hash(), .serial = serial, .total = payload.size()});
    for (Child& child : children_) {
        for (Item& item : child.items)
            if (item.serial == serial) item.whole = payload;
        pump(child);
    }
}

/// Where it is wanted and has not begun: the same upload may come from two sources.
void Relays::enqueue(Item item) {
    for (Child& child : children_) {
        if (child.begun.contains(item.serial)) continue;
        if (child.wanted.erase(item.serial) == 0 && item.serial <= child.relay.after) continue;
        child.begun.insert(item.serial);
        child.items.push_back(item);
    }
}

/// Sends the next part of the first upload, if there is one and the connection is free for it.
void Relays::pump(Child& child) {
    if (!child.channel || !child.channel->isSecured() || !child.channel->isIdle()) return;
    if (child.items.empty()) return;
    const Item& item = child.items.front();
    const auto here = item.whole ? item.whole.bytes() : gate_.unfinished(item.serial);
    if (here.size() <= child.offset) return;
    const auto rest = here.subspan(child.offset);
    const auto chunk = rest.first(std::min(rest.size(), chunkBytes));
    // What is unfinished may move.
    const Part part = item.whole ? Part{.owner = std::make_shared<const field::Payload>(item.whole),
                                        .bytes = chunk}
                                 : Part::of({chunk.begin(), chunk.end()});
    const Compress use = child.relay.compress;
    packers_.try_emplace(use, use).first->second.queue(*child.channel,
                                                       packet(wire::Payload{.hash = item.hash,
                                                                            .serial = item.serial,
                                                                            .total = item.total,
                                                                            .offset = child.offset,
                                                                            .tail = chunk}),
                                                       part);
    child.offset += chunk.size();
    if (child.offset == item.total) {
        child.items.pop_front();
        child.offset = 0;
    }
    child.channel->flush();
}

Result<void> Relays::received(Channel&, MessageType, std::span<const std::byte> body) {
    auto refused = decode<wire::Refused>(body);  // Route lets nothing else through
    if (!refused) return tl::unexpected{std::move(refused).error()};
    return fail(Errc::disconnected, "refused: " + refused->why);
}

void Relays::drained(Channel& channel) {
    for (Child& child : children_)
        if (child.channel.get() == &channel) pump(child);
}

void Relays::closed(Channel& channel, Error why) {
    const auto at = std::find_if(children_.begin(), children_.end(), [&](const Child& child) {
        return child.channel.get() == &channel;
    });
    if (at != children_.end()) drop(at->relay.token, why.text());
}

}  // namespace gnomon::net
