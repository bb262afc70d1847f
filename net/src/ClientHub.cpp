#include <fmt/format.h>
#include <gnomon/net/ClientHub.h>

#include <thread>

#include "HubCore.h"

namespace gnomon::net {

class ClientHub::Impl {
public:
    Impl(const field::TypeRegistry& types, SyncOptions options, HubHooks hooks,
         const SharedKey& key)
        : core_{std::make_unique<HubCore>(io_, types, options, std::move(hooks), key, mailbox_)},
          thread_{[this] { run(); }} {}

    ~Impl() { shutdown(); }

    void shutdown() {
        if (!thread_.joinable()) return;
        asio::post(io_, [this] { core_->stop([this] { io_.stop(); }); });
        thread_.join();
    }

    /// Runs fn(core) on the hub's thread and waits for its value; nothing after shutdown.
    template <class Fn>
    auto ask(Fn fn) -> std::optional<decltype(fn(std::declval<HubCore&>()))> {
        using Value = decltype(fn(std::declval<HubCore&>()));
        auto slot = std::make_shared<std::optional<Value>>();
        asio::post(io_, [this, slot, fn = std::move(fn)]() mutable {
            Value value = fn(*core_);
            {
                const std::lock_guard lock{mailbox_.mutex};
                slot->emplace(std::move(value));
            }
            mailbox_.changed.notify_all();
        });
        std::unique_lock lock{mailbox_.mutex};
        mailbox_.changed.wait(lock, [&] { return slot->has_value() || mailbox_.stopped; });
        return std::move(*slot);
    }

    std::uint64_t version() {
        const std::lock_guard lock{mailbox_.mutex};
        return mailbox_.version;
    }
    /// False at the deadline and after shutdown.
    bool waitForChange(std::uint64_t seen, Deadline deadline) {
        std::unique_lock lock{mailbox_.mutex};
        mailbox_.changed.wait_until(lock, deadline,
                                    [&] { return mailbox_.version != seen || mailbox_.stopped; });
        return mailbox_.version != seen && !mailbox_.stopped;
    }

    void run() {
        std::exception_ptr error;
        try {
            io_.run();
        } catch (...) {
            error = std::current_exception();
        }
        {
            const std::lock_guard lock{mailbox_.mutex};
            mailbox_.stopped = true;
            broken_ = error;
        }
        mailbox_.changed.notify_all();
    }

    [[noreturn]] void throwStopped() {
        if (broken_) std::rethrow_exception(broken_);
        throw Failure{Errc::disconnected, "the client hub was shut down"};
    }

    asio::io_context io_{1};
    asio::executor_work_guard<asio::io_context::executor_type> work_{io_.get_executor()};
    Mailbox mailbox_;
    std::exception_ptr broken_;  // guarded by the mailbox's mutex
    std::unique_ptr<HubCore> core_;
    std::thread thread_;
};

ClientHub::ClientHub(const field::TypeRegistry& types, SyncOptions options, HubHooks hooks,
                     const SharedKey& key)
    : impl_{std::make_unique<Impl>(types, options, std::move(hooks), key)} {}

ClientHub::~ClientHub() = default;

void ClientHub::connect(ServerAddress address) {
    asio::post(impl_->io_, [core = impl_->core_.get(), address = std::move(address)]() mutable {
        core->connect(std::move(address));
    });
}

Result<void> ClientHub::waitForAll(
    const std::function<void(const std::vector<ServerStatus>&)>& progress, Deadline deadline) {
    while (true) {
        const std::uint64_t seen = impl_->version();
        const auto servers = status();
        if (progress) progress(servers);
        std::string missing;
        for (const ServerStatus& server : servers) {
            if (server.state == ServerState::member) continue;
            const auto label = fmt::format("{} ({}:{})", server.address.name, server.address.host,
                                           server.address.port);
            missing += missing.empty() ? "" : "; ";
            // An error of the peer begins with its label already.
            missing += server.text.rfind(label, 0) == 0 ? server.text : label + ": " + server.text;
        }
        if (missing.empty()) return {};
        if (!impl_->waitForChange(seen, deadline) && std::chrono::steady_clock::now() >= deadline)
            return fail(Errc::timeout, "not all servers take part: " + missing);
        const std::lock_guard lock{impl_->mailbox_.mutex};
        if (impl_->mailbox_.stopped) return fail(Errc::disconnected, "the hub was shut down");
    }
}

FrameResult ClientHub::frame(field::ChangeList changes, double time, bool capture) {
    auto call = std::make_shared<FrameCall>();
    call->list = std::move(changes);
    call->time = time;
    call->capture = capture;
    asio::post(impl_->io_, [core = impl_->core_.get(), call] { core->handOver(call); });
    Mailbox& mailbox = impl_->mailbox_;
    std::unique_lock lock{mailbox.mutex};
    mailbox.changed.wait(lock, [&] { return call->done || mailbox.stopped; });
    if (!call->done) impl_->throwStopped();
    if (call->error) std::rethrow_exception(call->error);
    return std::move(call->result);
}

Result<std::vector<TileImage>> ClientHub::takeImages(std::uint64_t n, Deadline deadline) {
    while (true) {
        const std::uint64_t seen = impl_->version();
        auto taken = impl_->ask([n](HubCore& core) { return core.takeImages(n); });
        if (!taken) return fail(Errc::disconnected, "the client hub was shut down");
        if (*taken) return **std::move(taken);
        if (impl_->waitForChange(seen, deadline) || std::chrono::steady_clock::now() < deadline)
            continue;
        const auto who = impl_->ask([n](HubCore& core) { return core.imagesWaitFor(n); });
        return fail(
            Errc::timeout,
            fmt::format("the pictures of frame {} did not arrive in time{}", n,
                        who && !who->empty() ? ": missing are those of " + *who : std::string{}));
    }
}

std::vector<InputEventFrom> ClientHub::takeEvents() {
    const std::lock_guard lock{impl_->mailbox_.mutex};
    auto& events = impl_->mailbox_.events;
    std::vector<InputEventFrom> taken{std::make_move_iterator(events.begin()),
                                      std::make_move_iterator(events.end())};
    events.clear();
    return taken;
}

std::vector<ServerStatus> ClientHub::status() const {
    return impl_->ask([](HubCore& core) { return core.status(); })
        .value_or(std::vector<ServerStatus>{});
}

HubTotals ClientHub::totals() const {
    return impl_->ask([](HubCore& core) { return core.totals(); }).value_or(HubTotals{});
}

void ClientHub::shutdown() { impl_->shutdown(); }

}  // namespace gnomon::net
