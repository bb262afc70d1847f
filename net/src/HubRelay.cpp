// The tree that payloads go down: the client sends to a few servers, each passes on to a few more.
// Frames, swaps and snapshots go to every server directly, so a lost relay costs nobody a frame;
// those behind it get what they miss from another one, or from the client.
#include <fmt/format.h>

#include <algorithm>

#include "HubCore.h"

namespace gnomon::net {
namespace {

bool isHere(const Peer& peer) {
    error_code ec;
    const auto address = asio::ip::make_address(peer.address().host, ec);
    return ec ? peer.address().host == "localhost" : isLoopback(address);
}

bool isBehind(const Peer& one, const Peer& other) {
    for (const Peer* at = &one; at != nullptr; at = at->standing.relay)
        if (at == &other) return true;
    return false;
}

}  // namespace

/// The one nearest to us that has room; nullptr: ourselves.
Peer* HubCore::relayFor(const Peer& peer) const {
    if (options_.relay <= 0) return nullptr;
    int direct = 0;
    Peer* best = nullptr;
    for (const auto& other : peers_) {
        const Standing& standing = other->standing;
        if (other.get() == &peer || !standing.joined) continue;
        if (standing.relay == nullptr) ++direct;
        // "localhost" is another machine for a server elsewhere.
        if (isHere(peer) && !isHere(*other)) continue;
        if (standing.relays >= options_.relay || isBehind(*other, peer)) continue;
        if (best == nullptr || standing.level < best->standing.level) best = other.get();
    }
    return direct < options_.relay ? nullptr : best;
}

/// Sees to it that it gets what it may not have, and all that comes from now on. It is ready for a
/// frame only when it had all that the frame needs.
void HubCore::provide(Peer& peer, Peer* relay) {
    const auto missing = ledger_.since(peer.standing.lastReady, peer.standing.applied());
    peer.standing.relay = relay;
    peer.standing.level = relay != nullptr ? relay->standing.level + 1 : 0;
    if (relay == nullptr) {
        for (const auto& kept : missing) uploadTo(peer, kept);
        return;
    }
    ++relay->standing.relays;
    wire::Relay message{.token = peer.token(),
                        .host = peer.address().host,
                        .port = peer.address().port,
                        .after = ledger_.newest(),
                        .compress = options_.compress};
    message.uploads.reserve(missing.size());
    for (const auto& kept : missing) {
        if (kept.released == 0)
            message.uploads.push_back(kept.serial);
        else  // the relay may be rid of it by now
            uploadTo(peer, kept);
    }
    relay->queue(Part::of(packet(message)));
    relay->flush();
}

/// Nobody behind a relay can need it any more.
void HubCore::forgetReleased() {
    if (!ledger_.holdsAny()) return;
    std::uint64_t have = preparedN_;
    for (const auto& peer : peers_) {
        const Standing& standing = peer->standing;
        if (standing.joined && standing.relay != nullptr) have = std::min(have, standing.applied());
    }
    ledger_.forget(have);
}

void HubCore::leaveTree(Peer& peer) {
    if (Peer* relay = peer.standing.relay) {
        --relay->standing.relays;
        relay->queue(Part::of(packet(wire::RelayEnd{.token = peer.token()})));
        relay->flush();
        peer.standing.relay = nullptr;
    }
    // Posted: peers are lost in loops over them, and this one has not left yet.
    if (peer.standing.relays > 0)
        asio::post(io_, [this, gone = &peer] {
            if (stopped_) return;
            for (const auto& child : peers_)
                if (child->standing.joined && child->standing.relay == gone)
                    provide(*child, relayFor(*child));
        });
}

void HubCore::relayLost(Peer& peer, const wire::RelayLost& lost) {
    const auto found = std::find_if(peers_.begin(), peers_.end(), [&](const auto& child) {
        return child->standing.joined && child->standing.relay == &peer &&
               child->token() == lost.token;
    });
    if (found == peers_.end()) return;  // it has gone meanwhile
    Peer& child = **found;
    log(LogLevel::info, fmt::format("{}: cannot pass payloads on to {}: {}", peer.label(),
                                    child.label(), lost.why));
    --peer.standing.relays;
    provide(child, nullptr);
}

}  // namespace gnomon::net
