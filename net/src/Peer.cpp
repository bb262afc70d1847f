#include "Peer.h"

#include <fmt/format.h>

#include <algorithm>

#include "Token.h"

namespace gnomon::net {
namespace {

constexpr Milliseconds firstRetry{50};
constexpr Milliseconds lastRetry{2000};
constexpr Milliseconds connectLimit{5000};
/// Pings at the start of a connection come quickly, so that the clock is known at once.
constexpr int quickPings = 8;
constexpr Milliseconds quickInterval{10};
/// How long others may take to answer a lookup before one that failed is tried again.
constexpr Milliseconds gathering{100};

}  // namespace

Peer::Peer(asio::io_context& io, ServerAddress address, const SyncOptions& options,
           PeerOwner& owner, std::shared_ptr<const TlsContext> tls, Packer& packer)
    : address_{std::move(address)},
      options_{options},
      owner_{owner},
      tls_{std::move(tls)},
      dialer_{io, tls_ != nullptr},
      candidates_{randomToken()},
      bulk_{packer},
      timer_{io},
      pingTimer_{io} {
    if (address_.lookup.empty()) return;
    finder_ = std::make_unique<Finder>(
        io, address_.name, address_.lookup, tls_ != nullptr, [this](const std::string& what) {
            owner_.log(LogLevel::warning, address_.name + ": " + what);
        });
}

std::string Peer::label() const { return labelOf(address_); }

void Peer::open(ServerAddress address) {
    const bool moved = !finder_ && (address.host != address_.host || address.port != address_.port);
    if (moved && state_ != ServerState::waiting)
        drop({.code = Errc::disconnected,
              .what = fmt::format("{} moved to {}:{}", label(), address.host, address.port)});
    address_ = std::move(address);
    retryDelay_ = firstRetry;
    if (state_ == ServerState::waiting) connect();
}

void Peer::connect() {
    if (stopping_) return;
    if (finder_)
        tryNext();
    else
        attempt();
}

/// The next of those that answered to its name; they are asked for anew where there is none.
void Peer::tryNext(std::optional<SteadyClock::duration> after) {
    const auto next = candidates_.next();
    if (!next) return look();
    address_.host = next->host;
    address_.port = next->port;
    if (saidFound_ != label()) {
        saidFound_ = label();
        const auto when =
            after ? fmt::format(", {:.2f} ms after it was asked for", millisecondsOf(*after))
                  : std::string{};
        owner_.log(LogLevel::info, label() + ": found" + when);
    }
    attempt();
}

void Peer::look() {
    address_.host.clear();
    address_.port = 0;
    state_ = ServerState::looking;
    candidates_.begin();
    saidVersion_ = false;
    if (!std::exchange(saidLooking_, true))
        owner_.log(LogLevel::info, fmt::format("{}: {}", address_.name, stateText()));
    owner_.changed();
    finder_->start([this](const Finder::Heard& from) { heard(from); });
}

/// Anybody may answer. One that failed before is tried after all who did not, also those that have
/// not answered yet.
void Peer::heard(const Finder::Heard& from) {
    if (from.version != protocolVersion) {
        if (state_ != ServerState::looking || std::exchange(saidVersion_, true)) return;
        lastError_ =
            fmt::format("{} ({}:{}): it answers with protocol version {}, expected {}",
                        address_.name, from.host, from.port, from.version, protocolVersion);
        unfit_ = !everMember;
        owner_.log(LogLevel::warning, lastError_);
        owner_.changed();
        return;
    }
    candidates_.add({.host = from.host, .port = from.port}, from.instance);
    if (const auto rivals = candidates_.rivals())
        owner_.log(LogLevel::warning,
                   fmt::format("{}: two servers have this name, at {}:{} and {}:{}; each needs its "
                               "own, and one of them is used",
                               address_.name, rivals->first.host, rivals->first.port,
                               rivals->second.host, rivals->second.port));
    if (state_ != ServerState::looking || !candidates_.failuresOfNext()) return;
    finder_->settle();
    if (*candidates_.failuresOfNext() == 0)
        tryNext(from.after);
    else if (!timer_.armed())
        timer_.after(gathering, [this] { tryNext(); });
}

/// Connects to where address_ says.
void Peer::attempt() {
    state_ = ServerState::connecting;
    owner_.changed();
    timer_.after(std::min(connectLimit, options_.startTimeout), [this] {
        drop({.code = Errc::timeout, .what = label() + ": no answer to the connection attempt"});
    });
    dial(&Peer::greet);
}

void Peer::dial(Connected then) {
    dialer_.dial(address_.host, address_.port, label(), [this, then](Result<tcp::socket> socket) {
        if (!socket) return drop(std::move(socket).error());
        (this->*then)(*std::move(socket));
    });
}

std::unique_ptr<TlsSession> Peer::seal() const {
    return tls_ ? std::make_unique<TlsSession>(tls_) : nullptr;
}

void Peer::greet(tcp::socket socket) {
    control_ = std::make_shared<Channel>(std::move(socket), Route::toClientControl, *this, seal());
    token_ = randomToken();
    auto hello = owner_.greeting();
    hello.role = wire::Role::control;
    hello.token = token_;
    state_ = ServerState::greeting;
    owner_.changed();
    if (tls_)
        timer_.after(std::min(connectLimit, options_.startTimeout), [this] {
            drop({.code = Errc::timeout, .what = label() + ": no end of the TLS handshake"});
        });
    else
        awaitHello();
    control_->start();
    control_->send(Part::of(packet(hello)));
}

void Peer::secured(Channel& channel) {
    if (&channel == control_.get() && state_ == ServerState::greeting) awaitHello();
}

void Peer::awaitHello() {
    timer_.after(options_.startTimeout, [this] {
        drop({.code = Errc::timeout,
              .what = fmt::format("{}: no answer to Hello within {} ms", label(),
                                  options_.startTimeout.count())});
    });
}

Result<void> Peer::welcome(std::span<const std::byte> body) {
    if (state_ != ServerState::greeting) return fail(Errc::protocol, "a second Hello");
    auto hello = decode<wire::ServerHello>(body);
    if (!hello) return tl::unexpected{std::move(hello).error()};
    if (auto agreed = owner_.checkSchema(hello->schema, "server " + label()); !agreed)
        return agreed;
    description_ = hello->description;
    unfit_ = false;
    candidates_.worked(place());
    state_ = ServerState::joining;
    timer_.after(std::min(connectLimit, options_.startTimeout), [this] {
        drop({.code = Errc::timeout, .what = label() + ": no answer to the bulk connection"});
    });
    dial(&Peer::joinBulk);
    ping();
    owner_.changed();
    return {};
}

void Peer::joinBulk(tcp::socket socket) {
    bulkChannel_ = std::make_shared<Channel>(std::move(socket), Route::toClientBulk, *this, seal());
    bulkChannel_->expectBulk();
    auto hello = owner_.greeting();
    hello.role = wire::Role::bulk;
    hello.token = token_;
    hello.schema.clear();
    bulkChannel_->start();
    bulkChannel_->send(Part::of(packet(hello)));
    bulk_.attach(bulkChannel_);
    bulk_.drained();  // progress counts from here
    watchLoading();
    owner_.connected(*this);
}

/// A joiner may take startTimeout after its last upload.
void Peer::watchLoading() {
    const auto due = lastProgress() + options_.startTimeout;
    if (SteadyClock::now() < due) return timer_.at(due, [this] { watchLoading(); });
    drop({.code = Errc::timeout,
          .what = fmt::format("{}: {} for more than {} ms", label(), stateText(),
                              options_.startTimeout.count())});
}

void Peer::becomeMember() {
    timer_.cancel();
    state_ = ServerState::member;
    lastError_.clear();
    lastLogged_.clear();
    saidLooking_ = false;
    saidFound_.clear();
    retryDelay_ = firstRetry;
    standing.member = true;
    standing.memberSince = SteadyClock::now();
    if (everMember) ++timesRejoined;
    everMember = true;
    owner_.changed();
}

void Peer::ping() {
    if (!control_ || !control_->isOpen()) return;
    control_->send(Part::of(packet(wire::Ping{.sentAt = steadyNanoseconds()})));
    const auto interval = ++pings_ < quickPings ? std::min(quickInterval, options_.pingInterval)
                                                : options_.pingInterval;
    pingTimer_.after(interval, [this] { ping(); });
}

Result<void> Peer::received(Channel& from, MessageType type, std::span<const std::byte> body) {
    if (type == MessageType::refused) {
        auto refused = decode<wire::Refused>(body);
        if (!refused) return tl::unexpected{std::move(refused).error()};
        const bool final = refused->cure == wire::Cure::restart;
        drop({.code = final ? Errc::protocol : Errc::disconnected,
              .what = fmt::format("{}: refused: {}", label(), refused->why)});
        return {};
    }
    if (&from == bulkChannel_.get()) return imagePart(body);
    if (&from != control_.get()) return {};
    if (type == MessageType::serverHello) return welcome(body);
    if (state_ == ServerState::greeting) return fail(Errc::protocol, "a message before Hello");
    const auto take = [&]<class M>(auto&& use) -> Result<void> {
        auto message = decode<M>(body);
        if (!message) return tl::unexpected{std::move(message).error()};
        return use(*message);
    };
    switch (type) {
        case MessageType::ready:
            return take.operator()<Ready>([&](const Ready& m) { return owner_.ready(*this, m); });
        case MessageType::depth:
            return take.operator()<Depth>([&](const Depth& m) { return owner_.depth(*this, m); });
        case MessageType::digest:
            return take.operator()<Digest>([&](const Digest& m) -> Result<void> {
                owner_.digest(*this, m);
                return {};
            });
        case MessageType::digests:
            return take.operator()<Digests>([&](const Digests& m) -> Result<void> {
                owner_.digests(*this, m);
                return {};
            });
        case MessageType::event:
            return take.operator()<InputEvent>([&](const InputEvent& m) -> Result<void> {
                owner_.event(*this, m);
                return {};
            });
        case MessageType::relayLost:
            return take.operator()<wire::RelayLost>([&](const wire::RelayLost& m) -> Result<void> {
                owner_.relayLost(*this, m);
                return {};
            });
        case MessageType::log:
            return take.operator()<Log>([&](const Log& m) -> Result<void> {
                owner_.log(m.level, label() + ": " + m.text);
                return {};
            });
        case MessageType::pong:
            return pongArrived(body);
        default:
            return {};  // Route lets nothing else through
    }
}

Result<void> Peer::pongArrived(std::span<const std::byte> body) {
    auto pong = decode<wire::Pong>(body);
    if (!pong) return tl::unexpected{std::move(pong).error()};
    const std::int64_t now = steadyNanoseconds();
    if (pong->sentAt < 0 || pong->sentAt > now)
        return fail(Errc::protocol,
                    fmt::format("Pong to a Ping of {} ns, at {}", pong->sentAt, now));
    clock_.add(pong->sentAt, pong->serverClock, now);
    if (pong->arrived > arrived_) arrivedAt_ = SteadyClock::now();
    arrived_ = pong->arrived;
    const bool news = !pong_ || pong_->activity != pong->activity;
    pong_ = *pong;
    if (news) owner_.changed();
    return {};
}

Result<void> Peer::imagePart(std::span<const std::byte> body) {
    auto part = decode<wire::Image>(body);
    if (!part) return tl::unexpected{std::move(part).error()};
    if (!image_) {
        image_ = Image{.n = part->n,
                       .window = part->window,
                       .x = part->x,
                       .y = part->y,
                       .width = part->width,
                       .height = part->height,
                       .channels = part->channels};
        imageArrived_ = 0;
    }
    if (part->offset != imageArrived_ || part->n != image_->n || part->window != image_->window ||
        part->width != image_->width || part->height != image_->height ||
        part->channels != image_->channels)
        return fail(Errc::protocol, fmt::format("Image of frame {} at byte {}: found byte {} of "
                                                "frame {}",
                                                image_->n, imageArrived_, part->offset, part->n));
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(part->tail.data());
    image_->pixels.insert(image_->pixels.end(), bytes, bytes + part->tail.size());
    imageArrived_ += part->tail.size();
    if (imageArrived_ < part->total()) return {};
    Image whole = std::move(*image_);
    image_.reset();
    return owner_.image(*this, std::move(whole));
}

void Peer::drained(Channel& channel) {
    if (&channel == bulkChannel_.get()) bulk_.drained();
}

void Peer::closed(Channel& channel, Error why) {
    if (&channel != control_.get() && &channel != bulkChannel_.get()) return;
    why.what = label() + (why.cause ? "" : ": " + why.what);
    drop(std::move(why));
}

void Peer::closeAll() {
    timer_.cancel();
    pingTimer_.cancel();
    dialer_.cancel();
    if (control_) {
        pastControlBytes_ += control_->bytesSent();
        pastControlWrites_ += control_->writes();
        control_->close();
        control_.reset();
    }
    if (bulkChannel_) {
        pastBulkBytes_ += bulkChannel_->bytesSent();
        bulkChannel_->close();
        bulkChannel_.reset();
    }
    bulk_.clear();
    clock_ = {};
    pong_.reset();
    pings_ = 0;
    arrived_ = 0;
    image_.reset();
}

void Peer::drop(Error why) {
    if (state_ == ServerState::connecting || state_ == ServerState::greeting)
        candidates_.failed(place());
    closeAll();
    state_ = ServerState::waiting;
    lastError_ = why.text();
    // Within a session these are a fault, which may pass; before it they are what the two are.
    unfit_ = !everMember && (why.code == Errc::protocol || why.code == Errc::schema);
    if (standing.member) ++timesLost;
    if (!stopping_ && lastError_ != lastLogged_) {
        lastLogged_ = lastError_;
        owner_.log(standing.member || unfit_ ? LogLevel::warning : LogLevel::info, lastError_);
    }
    owner_.lost(*this, why);
    standing = {};
    owner_.changed();
    if (stopping_) return;
    const bool another = candidates_.failuresOfNext().has_value();
    timer_.after(another ? Milliseconds{0} : retryDelay_, [this] { connect(); });
    if (!another) retryDelay_ = std::min(retryDelay_ * 2, lastRetry);
}

void Peer::stop() {
    stopping_ = true;
    if (finder_) finder_->stop();
    if (!control_ || !control_->isOpen()) {
        closeAll();
        state_ = ServerState::waiting;
        return;
    }
    timer_.cancel();
    pingTimer_.cancel();
    bulk_.clear();  // the channel stays: its end must not overtake the goodbye
    control_->send(Part::of(packet(wire::Bye{})));
    control_->finish();
}

std::uint64_t Peer::controlBytes() const noexcept {
    return pastControlBytes_ + (control_ ? control_->bytesSent() : 0);
}
std::uint64_t Peer::controlWrites() const noexcept {
    return pastControlWrites_ + (control_ ? control_->writes() : 0);
}
std::uint64_t Peer::bulkBytes() const noexcept {
    return pastBulkBytes_ + (bulkChannel_ ? bulkChannel_->bytesSent() : 0);
}

std::string Peer::stateText() const {
    switch (state_) {
        case ServerState::waiting:
            return lastError_.empty() ? "not connected" : lastError_;
        case ServerState::looking:
            return fmt::format("waiting for an announcement of \"{}\" on {} (udp){}{}",
                               address_.name, address_.lookup,
                               tls_ ? "" : ", from this machine only: there is no cluster key",
                               lastError_.empty() ? "" : "; " + lastError_);
        case ServerState::connecting:
            return lastError_.empty() ? "connecting" : lastError_ + " (trying again)";
        case ServerState::greeting:
            return control_ && !control_->isSecured() ? "connected, no end of the TLS handshake yet"
                                                      : "connected, no answer to Hello yet";
        case ServerState::joining:
            if (bulk_.waitingBytes() > 0)
                return fmt::format("loading ({:.1f} MB to be sent)",
                                   static_cast<double>(bulk_.waitingBytes()) * 1e-6);
            if (pong_ && pong_->activity == Activity::compiling) return "compiling";
            if (pong_ && pong_->activity == Activity::rendering) return "rendering its first frame";
            return "loading";
        case ServerState::member:
            return "takes part";
    }
    return {};
}

ServerStatus Peer::status() const {
    ServerStatus status{.address = address_,
                        .state = state_,
                        .text = stateText(),
                        .unfit = unfit_,
                        .description = description_,
                        .lastReady = standing.lastReady,
                        .stats = standing.stats,
                        .toUpload = bulk_.waitingBytes(),
                        .lost = timesLost,
                        .rejoined = timesRejoined};
    if (pong_) {
        status.activity = pong_->activity;
        status.current = pong_->current;
        status.busyMs = pong_->busyMs;
    }
    if (standing.relay != nullptr) status.relay = standing.relay->name();
    if (const auto trip = clock_.trip()) status.tripMs = static_cast<double>(*trip) * 1e-6;
    return status;
}

}  // namespace gnomon::net
