#include <fmt/format.h>
#include <gnomon/net/ServerHost.h>

#include "HostCore.h"
#include "Reactor.h"

namespace gnomon::net {
namespace {

/// What peek() tells of the sockets may be so old.
constexpr Milliseconds lookAgain{1};

tcp::acceptor listen(asio::io_context& io, const ServerOptions& options) {
    const auto refuse = [&](const std::string& why, error_code ec = {}) {
        return Failure{
            {.code = Errc::config,
             .what = fmt::format("server \"{}\": cannot listen on {}:{}{}", options.name,
                                 options.address, options.port, why.empty() ? why : ": " + why),
             .cause = ec}};
    };
    error_code ec;
    const auto address = asio::ip::make_address(options.address, ec);
    if (ec) throw refuse("not a numeric IPv4 or IPv6 address, such as 127.0.0.1");
    if (!isLoopback(address) && !options.key)
        throw refuse("other computers may only connect with a cluster key, and there is none");
    const tcp::endpoint end{address, options.port};
    tcp::acceptor acceptor{io};
    if (acceptor.open(end.protocol(), ec)) throw refuse({}, ec);
    acceptor.set_option(tcp::acceptor::reuse_address{true}, ec);
    if (acceptor.bind(end, ec)) throw refuse({}, ec);
    if (acceptor.listen(tcp::acceptor::max_listen_connections, ec)) throw refuse({}, ec);
    return acceptor;
}

}  // namespace

bool needsKey(const std::string& address) {
    error_code ec;
    const auto parsed = asio::ip::make_address(address, ec);
    return !ec && !isLoopback(parsed);
}

Digests digestsOf(std::uint64_t n, field::Aspect& aspect) {
    Digests digests{.n = n};
    for (const auto& [id, digest] : aspect.digests()) {
        if (digests.list.size() == maxDigests) break;
        digests.list.push_back({.id = id.value, .digest = digest});
    }
    return digests;
}

class ServerHost::Impl {
public:
    Impl(ServerOptions options, field::TypeRegistry& types) : types_{types} {
        reactor_.alone([&] {
            auto acceptor = listen(reactor_.io(), options);
            port_ = acceptor.local_endpoint().port();
            core_ = std::make_unique<HostCore>(reactor_.io(), std::move(acceptor),
                                               std::move(options), inbox_, progress_);
            core_->start();
        });
    }

    ~Impl() {
        // Time for a last Refused to leave; nobody is waited for.
        bool stopped = false;
        reactor_.runUntil(
            [&] {
                if (!std::exchange(stopped, true)) core_->stop();
                return core_->quiet();
            },
            SteadyClock::now() + Milliseconds{50});
        reactor_.end();
    }

    template <class Fn>
    void onCore(Fn&& fn) {
        reactor_.enter([this, fn = std::forward<Fn>(fn)]() mutable { fn(*core_); });
    }
    void sendControl(std::vector<std::byte> bytes) {
        onCore([part = Part::of(std::move(bytes))](HostCore& core) mutable {
            core.sendControl(std::move(part));
        });
    }

    void agree(const SchemaOffer& offer) {
        auto outcome = types_.agree(offer.schema, offer.who);
        onCore([id = offer.session, outcome = std::move(outcome),
                schema = types_.schema()](HostCore& core) mutable {
            core.agreed(id, std::move(outcome), std::move(schema));
        });
    }

    void busyWith(std::uint64_t frame, Activity activity) {
        progress_.current = frame;
        progress_.busySince = steadyNanoseconds();
        progress_.activity = activity;
    }
    void finished(std::uint64_t frame) {
        if (frame != 0) progress_.lastFinished = frame;
        progress_.current = 0;
        progress_.busySince = 0;
        progress_.activity = Activity::idle;
    }

    field::TypeRegistry& types_;
    Inbox inbox_;
    Progress progress_;
    std::uint16_t port_ = 0;
    Reactor reactor_;
    std::unique_ptr<HostCore> core_;
    TimePoint lookedAt_ = {};     // at the sockets
    std::uint64_t imagesOf_ = 0;  // frame
    std::uint32_t images_ = 0;    // sent for it
};

ServerHost::ServerHost(ServerOptions options, field::TypeRegistry& types)
    : impl_{std::make_unique<Impl>(std::move(options), types)} {}

ServerHost::~ServerHost() = default;

std::uint16_t ServerHost::port() const noexcept { return impl_->port_; }

ServerEvent ServerHost::next(std::chrono::steady_clock::time_point deadline) {
    while (true) {
        auto item = impl_->inbox_.pop();
        if (!item) {
            impl_->reactor_.runUntil([&] { return !impl_->inbox_.empty(); }, deadline);
            impl_->lookedAt_ = SteadyClock::now();
            item = impl_->inbox_.pop();
        }
        if (!item) return Nothing{};
        if (const auto* offer = std::get_if<SchemaOffer>(&*item)) {
            impl_->agree(*offer);
            continue;
        }
        if (impl_->inbox_.throttled()) impl_->onCore([](HostCore& core) { core.throttle(); });
        ServerEvent event = std::get<ServerEvent>(std::move(*item));
        if (const auto* frame = std::get_if<Frame>(&event)) {
            impl_->busyWith(frame->n, Activity::rendering);
        } else if (const auto* snapshot = std::get_if<Snapshot>(&event)) {
            impl_->busyWith(snapshot->n, Activity::loading);
        } else if (std::holds_alternative<ClientLeft>(event) ||
                   std::holds_alternative<ClientJoined>(event)) {
            impl_->finished(0);
            impl_->progress_.lastFinished = 0;
        }
        return event;
    }
}

Queued ServerHost::peek() const {
    if (SteadyClock::now() - impl_->lookedAt_ > lookAgain) {
        impl_->reactor_.poll();
        impl_->lookedAt_ = SteadyClock::now();
    }
    return impl_->inbox_.peek();
}

void ServerHost::send(Ready ready) {
    ready.images = ready.n == impl_->imagesOf_ ? impl_->images_ : 0;
    impl_->finished(ready.n);
    impl_->sendControl(packet(ready));
}

void ServerHost::send(const Digest& digest) { impl_->sendControl(packet(digest)); }
void ServerHost::send(const Digests& digests) { impl_->sendControl(packet(digests)); }
void ServerHost::send(const Depth& depth) { impl_->sendControl(packet(depth)); }
void ServerHost::send(const InputEvent& event) { impl_->sendControl(packet(event)); }

void ServerHost::send(const Log& log) {
    impl_->sendControl(packet(Log{.level = log.level, .text = log.text.substr(0, 4096)}));
}

void ServerHost::send(Image image) {
    GNOMON_EXPECTS(image.pixels.size() == std::size_t{image.width} * image.height * image.channels,
                   "an image's pixels do not match its size");
    if (impl_->imagesOf_ != image.n) impl_->images_ = 0;
    impl_->imagesOf_ = image.n;
    ++impl_->images_;
    impl_->onCore([shared = std::make_shared<const Image>(std::move(image))](HostCore& core) {
        core.sendImage(shared);
    });
}

void ServerHost::setActivity(Activity activity) noexcept { impl_->progress_.activity = activity; }

void ServerHost::quit() {
    impl_->inbox_.push(ServerEvent{Quit{}}, 0);
    impl_->reactor_.nudge();
}

}  // namespace gnomon::net
