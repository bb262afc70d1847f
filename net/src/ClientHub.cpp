#include <fmt/format.h>
#include <gnomon/net/ClientHub.h>

#include "HubCore.h"
#include "Reactor.h"

namespace gnomon::net {
namespace {

/// Who does not take part, and why; for people.
std::string missingOf(const std::vector<ServerStatus>& servers) {
    std::string missing;
    for (const ServerStatus& server : servers) {
        if (server.state == ServerState::member) continue;
        const auto label = labelOf(server.address);
        missing += missing.empty() ? "" : "; ";
        // An error of the peer begins with its label already.
        missing += server.text.rfind(label, 0) == 0 ? server.text : label + ": " + server.text;
    }
    return missing;
}

}  // namespace

class ClientHub::Impl {
public:
    Impl(const field::TypeRegistry& types, SyncOptions options, HubHooks hooks,
         const SharedKey& key)
        : core_{std::make_unique<HubCore>(reactor_.io(), types, options, std::move(hooks), key)} {}

    ~Impl() { shutdown(); }

    void shutdown() noexcept {
        if (std::exchange(stopped_, true)) return;
        try {
            bool begun = false, ended = false;
            reactor_.runUntil(
                [&] {
                    if (!std::exchange(begun, true)) core_->stop([&] { ended = true; });
                    return ended;
                },
                TimePoint::max());
        } catch (...) {
            // Broken already, and its user was told.
        }
        reactor_.end();
    }

    Reactor reactor_;
    bool stopped_ = false;
    std::unique_ptr<HubCore> core_;
};

ClientHub::ClientHub(const field::TypeRegistry& types, SyncOptions options, HubHooks hooks,
                     const SharedKey& key)
    : impl_{std::make_unique<Impl>(types, options, std::move(hooks), key)} {}

ClientHub::~ClientHub() = default;

void ClientHub::connect(ServerAddress address) {
    if (impl_->stopped_) return;
    impl_->reactor_.alone([&] { impl_->core_->connect(std::move(address)); });
}

Result<void> ClientHub::waitForAll(
    const std::function<void(const std::vector<ServerStatus>&)>& progress, Deadline deadline) {
    std::optional<std::uint64_t> seen;
    while (!impl_->stopped_) {
        bool late = false;
        std::vector<ServerStatus> servers;
        impl_->reactor_.runUntil(
            [&] {
                late = SteadyClock::now() >= deadline;
                if (!late && seen == impl_->core_->version()) return false;
                seen = impl_->core_->version();
                servers = impl_->core_->status();
                return true;
            },
            deadline);
        if (progress) progress(servers);
        const std::string missing = missingOf(servers);
        if (missing.empty()) return {};
        if (late) return fail(Errc::timeout, "not all servers take part: " + missing);
    }
    return fail(Errc::disconnected, "the hub was shut down");
}

FrameResult ClientHub::frame(field::ChangeList changes, double time, bool capture) {
    if (impl_->stopped_) throw Failure{Errc::disconnected, "the client hub was shut down"};
    const auto call = std::make_shared<FrameCall>();
    call->list = std::move(changes);
    call->time = time;
    call->capture = capture;
    bool handedOver = false;
    impl_->reactor_.runUntil(
        [&] {
            if (!std::exchange(handedOver, true)) impl_->core_->handOver(call);
            impl_->reactor_.setEager(impl_->core_->busy());
            return call->done;
        },
        TimePoint::max());
    if (call->error) std::rethrow_exception(call->error);
    return std::move(call->result);
}

Result<std::vector<TileImage>> ClientHub::takeImages(std::uint64_t n, Deadline deadline) {
    if (impl_->stopped_) return fail(Errc::disconnected, "the client hub was shut down");
    std::optional<Result<std::vector<TileImage>>> taken;
    std::string missing;
    impl_->reactor_.runUntil(
        [&] {
            taken = impl_->core_->takeImages(n);
            if (!taken) missing = impl_->core_->imagesWaitFor(n);
            return taken.has_value();
        },
        deadline);
    if (taken) return *std::move(taken);
    return fail(Errc::timeout,
                fmt::format("the pictures of frame {} did not arrive in time{}", n,
                            missing.empty() ? missing : ": missing are those of " + missing));
}

std::vector<InputEventFrom> ClientHub::takeEvents() {
    std::deque<InputEventFrom> events;
    if (!impl_->stopped_) impl_->reactor_.alone([&] { events = impl_->core_->takeEvents(); });
    return {std::make_move_iterator(events.begin()), std::make_move_iterator(events.end())};
}

std::vector<ServerStatus> ClientHub::status() const {
    std::vector<ServerStatus> servers;
    if (!impl_->stopped_) impl_->reactor_.alone([&] { servers = impl_->core_->status(); });
    return servers;
}

HubTotals ClientHub::totals() const {
    HubTotals totals;
    if (!impl_->stopped_) impl_->reactor_.alone([&] { totals = impl_->core_->totals(); });
    return totals;
}

void ClientHub::shutdown() { impl_->shutdown(); }

}  // namespace gnomon::net
