#include "HostCore.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::net {
namespace {

constexpr std::size_t maxGuests = 16;
/// Frames that wait for the main thread or for payloads, beyond which control is not read on.
constexpr std::size_t maxBacklog = maxChangeBytes;
constexpr std::size_t maxWaitingImages = std::size_t{2} << 30U;
/// How long a connection that was sent away may take to read why.
constexpr Milliseconds sendFarewell{1000};
/// A client pings several times a second. One that was silent for so long keeps nobody out: a
/// machine without power, or behind a cut cable, sends no end of stream.
constexpr Milliseconds givesWayAfter{2000};

template <class M, class Fn>
Result<void> with(std::span<const std::byte> body, Fn&& fn) {
    auto message = decode<M>(body);
    if (!message) return tl::unexpected{std::move(message).error()};
    return fn(*std::move(message));
}

}  // namespace

HostCore::HostCore(asio::io_context& io, tcp::acceptor acceptor, ServerOptions options,
                   Inbox& inbox, const Progress& progress)
    : io_{io},
      acceptor_{std::move(acceptor)},
      options_{std::move(options)},
      tls_{options_.key ? std::make_shared<const TlsContext>(TlsSide::server, options_.key)
                        : nullptr},
      dialling_{options_.key ? std::make_shared<const TlsContext>(TlsSide::client, options_.key)
                             : nullptr},
      inbox_{inbox},
      progress_{progress},
      acceptTimer_{io},
      bulkTimer_{io},
      silentTimer_{io} {}

void HostCore::start() {
    if (!options_.announce.empty()) {
        const auto end = acceptor_.local_endpoint();
        announcer_ =
            std::make_unique<Announcer>(io_, AnnouncerOptions{.name = options_.name,
                                                              .listening = end.address(),
                                                              .port = end.port(),
                                                              .group = options_.announce,
                                                              .report = options_.turnedAway});
    }
    accept();
}

void HostCore::stop() {
    error_code ignored;
    acceptor_.close(ignored);
    acceptTimer_.cancel();
    announcer_.reset();
    if (session_) endSession({.code = Errc::disconnected, .what = "the server ends"}, true);
}

bool HostCore::quiet() const {
    return std::all_of(guests_.begin(), guests_.end(),
                       [](const Guest& guest) { return guest.channel->isIdle(); });
}

void HostCore::accept() {
    acceptor_.async_accept([this](error_code ec, tcp::socket socket) {
        if (!acceptor_.is_open()) return;
        if (ec)  // out of file descriptors, most likely: do not spin
            return acceptTimer_.after(Milliseconds{100}, [this] { accept(); });
        admit(std::move(socket));
        accept();
    });
}

void HostCore::admit(tcp::socket socket) {
    makeRoom();
    auto channel = std::make_shared<Channel>(std::move(socket), Route::toServerGreeting, *this,
                                             tls_ ? std::make_unique<TlsSession>(tls_) : nullptr);
    auto limit = std::make_unique<Timer>(io_);
    limit->after(options_.handshakeTimeout, [this, raw = channel.get()] {
        const auto guest = takeGuest(*raw);
        if (!guest) return;
        const auto ms = options_.handshakeTimeout.count();
        if (guest->isSecured()) return refuse(guest, fmt::format("no Hello within {} ms", ms));
        report(fmt::format("{}: no end of the TLS handshake within {} ms", guest->remote(), ms));
        guest->close();
    });
    guests_.push_back({.channel = channel, .limit = std::move(limit)});
    channel->start();
}

/// A newcomer takes the place of the one that is longest on its way in, if there is none left:
/// who only holds places open keeps nobody out for long.
void HostCore::makeRoom() {
    if (guests_.size() < maxGuests) return;
    const auto stranger = std::find_if(guests_.begin(), guests_.end(), [](const Guest& guest) {
        return !guest.channel->isSecured();
    });
    const auto goes = stranger != guests_.end() ? stranger : guests_.begin();
    const auto channel = goes->channel;
    guests_.erase(goes);
    report(
        fmt::format("{}: more than {} connections on their way in", channel->remote(), maxGuests));
    channel->close();
}

void HostCore::report(const std::string& why) {
    const auto now = SteadyClock::now();
    if (!options_.turnedAway || now - reportedAt_ < std::chrono::seconds{1}) return;
    reportedAt_ = now;
    options_.turnedAway("turned away " + why);
}

std::shared_ptr<Channel> HostCore::takeGuest(Channel& channel) {
    const auto found = std::find_if(guests_.begin(), guests_.end(), [&](const Guest& guest) {
        return guest.channel.get() == &channel;
    });
    if (found == guests_.end()) return nullptr;
    auto taken = std::move(found->channel);
    guests_.erase(found);
    return taken;
}

void HostCore::refuse(std::shared_ptr<Channel> channel, const std::string& why, wire::Cure cure) {
    channel->send(Part::of(packet(wire::Refused{.why = why.substr(0, 4096), .cure = cure})));
    channel->finish();
    auto limit = std::make_unique<Timer>(io_);
    limit->after(sendFarewell, [this, raw = channel.get()] {
        if (const auto guest = takeGuest(*raw)) guest->close();
    });
    guests_.push_back({.channel = std::move(channel), .limit = std::move(limit)});
}

Result<void> HostCore::received(Channel& from, MessageType type, std::span<const std::byte> body) {
    if (session_ && &from == session_->control.get()) return control(type, body);
    if (session_ && &from == session_->bulk.get()) return bulk(type, body);
    if (session_ && &from == session_->relay.get()) return relayed(type, body);
    return greeted(from, body);
}

Result<void> HostCore::greeted(Channel& from, std::span<const std::byte> body) {
    const auto guest = takeGuest(from);
    if (!guest) return {};
    auto hello = decode<wire::ClientHello>(body);
    if (!hello) {
        refuse(guest, hello.error().what, wire::Cure::restart);
    } else if (hello->role == wire::Role::bulk) {
        if (!session_ || session_->bulk || session_->token != hello->token) {
            refuse(guest, fmt::format("server \"{}\": this bulk connection belongs to no session",
                                      options_.name));
            return {};
        }
        bulkTimer_.cancel();
        guest->setRoute(Route::toServerBulk);
        guest->expectBulk();
        session_->bulk = guest;
        session_->images.attach(guest);
    } else if (hello->role == wire::Role::relay) {
        joinRelay(guest, hello->token);
    } else if (session_ && !givesWay()) {
        refuse(guest, fmt::format("server \"{}\" serves another client ({})", options_.name,
                                  session_->control->remote()));
    } else {
        if (session_)
            endSession({.code = Errc::timeout,
                        .what = fmt::format("it was silent for {} ms, and {} came",
                                            silence().count(), guest->remote())},
                       false);
        beginSession(guest, *std::move(hello));
    }
    return {};
}

/// A new one takes the place of one that was there: the client has found another way.
void HostCore::joinRelay(std::shared_ptr<Channel> channel, std::uint64_t token) {
    if (!session_ || session_->token != token)
        return refuse(
            std::move(channel),
            fmt::format("server \"{}\": this relay belongs to no session", options_.name));
    if (session_->relay) {
        session_->relay->close();
        session_->gate->sourceEnded(FrameGate::Source::relay);
    }
    channel->setRoute(Route::toServerRelay);
    channel->expectBulk();
    session_->relay = std::move(channel);
}

Milliseconds HostCore::silence() const {
    const auto heard = std::max(session_->control->lastHeard(),
                                session_->bulk ? session_->bulk->lastHeard() : TimePoint{});
    return std::chrono::duration_cast<Milliseconds>(SteadyClock::now() - heard);
}

/// Whether the client, silent as it is, is to be taken for gone now that there is another one.
bool HostCore::givesWay() const {
    // While we do not read, silence is our own doing; and some servers end with their client.
    return !inbox_.throttled() && !options_.exitWithClient && silence() >= givesWayAfter;
}

void HostCore::beginSession(std::shared_ptr<Channel> channel, wire::ClientHello hello) {
    channel->setRoute(Route::toServerControl);
    session_ = std::make_unique<Session>();
    session_->id = ++sessionCount_;
    session_->token = hello.token;
    session_->sync = hello.sync;
    session_->control = std::move(channel);
    session_->gate = std::make_unique<FrameGate>(
        options_.payloadBudget,
        [this](ServerEvent event, std::size_t bytes) { inbox_.push(std::move(event), bytes); });
    session_->relays = std::make_unique<Relays>(
        io_, dialling_, *session_->gate, [this](std::uint64_t token, const std::string& why) {
            session_->control->send(
                Part::of(packet(wire::RelayLost{.token = token, .why = why.substr(0, 4096)})));
        });
    session_->gate->setWatch(session_->relays.get());
    inbox_.push(SchemaOffer{.session = session_->id,
                            .who = "client " + session_->control->remote(),
                            .schema = std::move(hello.schema)},
                0);
    watch();
}

void HostCore::agreed(std::uint64_t id, Result<void> outcome, std::vector<std::byte> ourSchema) {
    if (!session_ || session_->id != id) return;
    if (!outcome) return endSession(outcome.error(), true);
    session_->joined = true;
    inbox_.push(
        ServerEvent{ClientJoined{.who = session_->control->remote(), .sync = session_->sync}}, 0);
    session_->control->send(Part::of(packet(wire::ServerHello{.server = options_.name,
                                                              .description = options_.description,
                                                              .schema = std::move(ourSchema)})));
    if (!session_->bulk) {
        bulkTimer_.after(options_.handshakeTimeout, [this] {
            endSession({.code = Errc::timeout,
                        .what = fmt::format("no bulk connection within {} ms",
                                            options_.handshakeTimeout.count())},
                       true);
        });
    }
}

Result<void> HostCore::control(MessageType type, std::span<const std::byte> body) {
    FrameGate& gate = *session_->gate;
    Result<void> done;
    switch (type) {
        case MessageType::frame:
            done = with<wire::Frame>(
                body, [&](wire::Frame message) { return gate.frame(std::move(message)); });
            break;
        case MessageType::fit:
            done =
                with<wire::Fit>(body, [&](const wire::Fit& message) { return gate.fit(message); });
            break;
        case MessageType::swap:
            done = with<wire::Swap>(body,
                                    [&](const wire::Swap& message) { return gate.swap(message); });
            break;
        case MessageType::ping:
            return with<wire::Ping>(body, [&](const wire::Ping& ping) -> Result<void> {
                answer(ping);
                return {};
            });
        case MessageType::relay:
            return with<wire::Relay>(body, [&](wire::Relay relay) -> Result<void> {
                session_->relays->add(std::move(relay));
                return {};
            });
        case MessageType::relayEnd:
            return with<wire::RelayEnd>(body, [&](const wire::RelayEnd& end) -> Result<void> {
                session_->relays->remove(end.token);
                return {};
            });
        case MessageType::bye:
            endSession({.code = Errc::disconnected, .what = "the client said goodbye"}, false);
            return {};
        default:
            break;  // Route lets nothing else through
    }
    if (!done) {
        endSession(done.error(), true);
        return {};
    }
    throttle();
    return {};
}

Result<void> HostCore::bulk(MessageType type, std::span<const std::byte> body) {
    if (type == MessageType::packed) {
        auto whole = session_->fromClient.unpack(body);
        if (whole) return bulk(whole->type, whole->body);
        endSession(std::move(whole).error(), true);
        return {};
    }
    FrameGate& gate = *session_->gate;
    auto done = type == MessageType::payload
                    ? with<wire::Payload>(
                          body, [&](const wire::Payload& part) { return gate.payload(part); })
                    : with<wire::Snapshot>(
                          body, [&](const wire::Snapshot& part) { return gate.snapshot(part); });
    if (!done) endSession(done.error(), true);
    throttle();  // frames that waited for payloads may have moved on
    return {};
}

Result<void> HostCore::relayed(MessageType type, std::span<const std::byte> body) {
    if (type == MessageType::packed) {
        auto whole = session_->fromRelay.unpack(body);
        if (!whole) return tl::unexpected{std::move(whole).error()};
        return relayed(whole->type, whole->body);
    }
    if (type != MessageType::payload)
        return fail(Errc::protocol, "another server passes on nothing but payloads");
    auto done = with<wire::Payload>(body, [&](const wire::Payload& part) {
        return session_->gate->payload(part, FrameGate::Source::relay);
    });
    // The relay may lie; the client, who chose it, may choose another way.
    if (!done) return done;
    throttle();
    return {};
}

void HostCore::answer(const wire::Ping& ping) {
    const std::int64_t now = steadyNanoseconds();
    const std::int64_t since = progress_.busySince.load();
    wire::Pong pong{.sentAt = ping.sentAt,
                    .serverClock = now,
                    .lastFinished = progress_.lastFinished.load(),
                    .current = progress_.current.load(),
                    .activity = progress_.activity.load(),
                    .arrived = session_->gate->bytesArrived()};
    if (since != 0) pong.busyMs = static_cast<std::uint32_t>((now - since) / 1'000'000);
    session_->control->send(Part::of(packet(pong)));
}

void HostCore::throttle() {
    if (!session_) return;
    const auto over = [&] { return session_->gate->waitingBytes() + inbox_.bytes() > maxBacklog; };
    if (over()) {
        session_->control->pause();
        inbox_.setThrottled(true);
        if (over()) return;
        // Else the main thread emptied the inbox before it saw that somebody waits for that.
    }
    if (!inbox_.throttled()) return;
    inbox_.setThrottled(false);
    session_->control->resume();
}

/// Ends a session whose client fell silent: a cut cable sends no end of stream.
void HostCore::watch() {
    // While we do not read, silence is our own doing.
    const auto left = options_.silentTimeout - (inbox_.throttled() ? Milliseconds{0} : silence());
    const auto due = SteadyClock::now() + left;
    if (left > Milliseconds{0}) return silentTimer_.at(due, [this] { watch(); });
    endSession(
        {.code = Errc::timeout,
         .what = fmt::format("the client was silent for {} ms", options_.silentTimeout.count())},
        true);
}

void HostCore::endSession(const Error& why, bool tellClient) {
    if (!session_) return;
    bulkTimer_.cancel();
    silentTimer_.cancel();
    // Dropped first: closing a channel may call back.
    const auto ended = std::move(session_);
    if (ended->bulk) ended->bulk->close();
    if (ended->relay) ended->relay->close();
    ended->relays.reset();
    if (tellClient && ended->control->isOpen())
        refuse(ended->control, why.text(),
               why.code == Errc::schema ? wire::Cure::restart : wire::Cure::time);
    else
        ended->control->close();
    inbox_.dropSession();
    inbox_.setThrottled(false);
    if (!ended->joined) return;
    inbox_.push(ServerEvent{ClientLeft{.why = why.text()}}, 0);
    if (options_.exitWithClient) inbox_.push(ServerEvent{Quit{}}, 0);
}

void HostCore::drained(Channel& channel) {
    if (session_ && &channel == session_->bulk.get()) session_->images.drained();
}

void HostCore::closed(Channel& channel, Error why) {
    if (session_ && (&channel == session_->control.get() || &channel == session_->bulk.get()))
        return endSession(why, &channel == session_->bulk.get());
    if (session_ && &channel == session_->relay.get()) {
        session_->relay.reset();
        session_->gate->sourceEnded(FrameGate::Source::relay);
        if (why.code == Errc::protocol || why.code == Errc::limit) report("relay " + why.text());
        return;
    }
    const auto guest = takeGuest(channel);
    if (guest && (!guest->isSecured() || why.code == Errc::protocol)) report(why.text());
}

void HostCore::sendControl(Part part) {
    if (session_ && session_->joined) session_->control->send(std::move(part));
}

void HostCore::sendImage(std::shared_ptr<const Image> image) {
    if (!session_ || !session_->joined) return;
    if (session_->images.waitingBytes() + image->pixels.size() > maxWaitingImages)
        return endSession({.code = Errc::limit, .what = "captured images are not read"}, true);
    const auto bytes = std::as_bytes(std::span{image->pixels});
    session_->images.add({.whole = {.owner = image, .bytes = bytes},
                          .head = [image](std::uint64_t offset, std::span<const std::byte> chunk) {
                              return packet(wire::Image{.n = image->n,
                                                        .window = image->window,
                                                        .x = image->x,
                                                        .y = image->y,
                                                        .width = image->width,
                                                        .height = image->height,
                                                        .channels = image->channels,
                                                        .offset = offset,
                                                        .tail = chunk});
                          }});
}

}  // namespace gnomon::net
