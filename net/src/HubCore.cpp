#include "HubCore.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::net {
namespace {

constexpr std::size_t maxEvents = 4096;
constexpr Milliseconds farewell{300};

}  // namespace

HubCore::HubCore(asio::io_context& io, const field::TypeRegistry& types, SyncOptions options,
                 HubHooks hooks, const SharedKey& key)
    : io_{io},
      types_{types},
      options_{options},
      hooks_{std::move(hooks)},
      tls_{key ? std::make_shared<const TlsContext>(TlsSide::client, key) : nullptr},
      session_{types, 1},
      packer_{options_.compress},
      watchTimer_{io},
      stopTimer_{io} {
    session_.followPayloads();
}

void HubCore::connect(ServerAddress address) {
    if (stopped_) return;
    const auto found = std::find_if(peers_.begin(), peers_.end(),
                                    [&](const auto& peer) { return peer->name() == address.name; });
    Peer* peer = nullptr;
    if (found != peers_.end()) {
        peer = found->get();
    } else {
        peers_.push_back(std::make_unique<Peer>(io_, address, options_, *this, tls_, packer_));
        peer = peers_.back().get();
    }
    peer->open(std::move(address));
}

std::vector<ServerStatus> HubCore::status() const {
    std::vector<ServerStatus> list;
    list.reserve(peers_.size());
    for (const auto& peer : peers_) list.push_back(peer->status());
    return list;
}

HubTotals HubCore::totals() const {
    HubTotals totals{.frames = swappedN_,
                     .sparedBytes = packer_.spared(),
                     .lost = lostCount_,
                     .rejoined = rejoinedCount_};
    for (const auto& peer : peers_) {
        totals.controlBytes += peer->controlBytes();
        totals.controlWrites += peer->controlWrites();
        totals.bulkBytes += peer->bulkBytes();
    }
    return totals;
}

void HubCore::stop(std::function<void()> done) {
    stopped_ = std::move(done);
    watchTimer_.cancel();
    for (const auto& peer : peers_) peer->stop();
    stopTimer_.after(farewell, [this] { stopped_(); });
    endIfSilent();
}

void HubCore::endIfSilent() {
    const bool all =
        std::all_of(peers_.begin(), peers_.end(), [](const auto& peer) { return peer->silent(); });
    if (all) stopped_();
}

wire::ClientHello HubCore::greeting() {
    const auto ms = [](Milliseconds value) { return static_cast<std::uint32_t>(value.count()); };
    return {.sync = {.timeoutMs = ms(options_.timeout),
                     .startTimeoutMs = ms(options_.startTimeout),
                     .pipeline = static_cast<std::uint8_t>(options_.pipeline),
                     .waitForLate = options_.waitForLate,
                     .digestEvery = static_cast<std::uint32_t>(std::max(options_.digestEvery, 0))},
            .schema = types_.schema()};
}

/// Compares in a registry of the moment: the application's own is read by its thread meanwhile,
/// and nothing a server alone knows ever comes here.
Result<void> HubCore::checkSchema(std::span<const std::byte> schema, const std::string& who) {
    field::TypeRegistry scratch;
    if (auto ours = scratch.agree(types_.schema(), "this client"); !ours) return ours;
    return scratch.agree(schema, who);
}

void HubCore::event(Peer& peer, const InputEvent& event) {
    if (events_.size() >= maxEvents) events_.pop_front();
    events_.push_back({.server = peer.name(), .event = event});
}

Result<void> HubCore::image(Peer& peer, Image image) {
    auto kept = captures_.add(peer.name(), std::move(image));
    changed();
    return kept;
}

void HubCore::log(LogLevel level, const std::string& text) {
    if (hooks_.log) hooks_.log(level, text);
}

void HubCore::changed() { ++version_; }

}  // namespace gnomon::net
