#include "ServerLink.h"

#include <fmt/format.h>
#include <gnomon/shadow_fit/ShadowFitter.h>

#include <algorithm>
#include <map>

namespace gnomon::client {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

namespace {

std::chrono::milliseconds milliseconds(double seconds) {
    return std::chrono::milliseconds{static_cast<std::int64_t>(seconds * 1000.0)};
}

net::SyncOptions syncOptions(const config::Config& config) {
    const config::Sync& sync = config.sync;
    net::SyncOptions options;
    options.timeout = milliseconds(sync.timeout);
    options.startTimeout = milliseconds(sync.startTimeout);
    options.waitForLate = sync.onTimeout == config::OnTimeout::wait;
    options.pipeline = sync.pipeline;
    options.relay = config.cluster.relay;
    switch (config.cluster.compress) {
        case config::Compress::automatic:
            options.compress = net::Compress::automatic;
            break;
        case config::Compress::never:
            options.compress = net::Compress::never;
            break;
        case config::Compress::always:
            options.compress = net::Compress::always;
            break;
    }
    return options;
}

/// Lets one line through at a time, whatever thread it comes from.
LogCallback oneAtATime(LogCallback log) {
    if (!log) return [](LogLevel, const std::string&) {};
    return [log = std::move(log), mutex = std::make_shared<std::mutex>()](LogLevel level,
                                                                          const std::string& line) {
        const std::lock_guard lock{*mutex};
        log(level, line);
    };
}

}  // namespace

ServerLink::ServerLink(const config::Config& config, const field::TypeRegistry& types,
                       const ApplicationOptions& options)
    : log_{oneAtATime(options.log)},
      sync_{syncOptions(config)},
      keyFile_{orThrow(findKeyFile(config, options))},
      hub_{types, sync_, hooks(), orThrow(loadKey(keyFile_))} {
    for (const auto& server : config.servers)
        if (isAwaited(config, server)) remote_.push_back(addressOf(config, server));
    LauncherOptions launch;
    launch.commands = launchCommands(config, options, keyFile_);
    std::map<std::string, std::string> hosts;
    for (const auto& command : launch.commands) hosts[command.server] = command.host;
    launch.log = [this](LogLevel level, const std::string& line) {
        // That we leave is no news.
        log_(ending_ && level == LogLevel::info ? LogLevel::debug : level, line);
    };
    launch.listening = [this, hosts = std::move(hosts)](const std::string& server,
                                                        std::uint16_t port) {
        const std::lock_guard lock{mutex_};
        listening_.push_back({.name = server, .host = hosts.at(server), .port = port});
        listens_.notify_all();
    };
    launched_ = launch.commands.size();
    if (launched_ > 0) launcher_ = std::make_unique<Launcher>(std::move(launch));
}

ServerLink::~ServerLink() { shutdown(); }

net::HubHooks ServerLink::hooks() const {
    net::HubHooks hooks;
    const auto log = log_;
    const auto fitter = std::make_shared<shadow_fit::ShadowFitter>(
        [log](const std::string& text) { log(LogLevel::warning, text); });
    hooks.prepare = [fitter](field::Aspect& session, const field::Applied& applied, std::uint64_t) {
        fitter->update(session, applied);
    };
    const auto span = [](float min, float max) {
        std::optional<shadow_fit::DepthSpan> seen;
        if (min <= max) seen = {.near = min, .far = max};
        return seen;
    };
    hooks.wantsDepth = [fitter](const field::Aspect&, std::uint64_t) {
        return fitter->wantsDepth();
    };
    hooks.fit = [fitter, span](field::Aspect& session, std::uint64_t, float min, float max) {
        fitter->fit(session, span(min, max));
    };
    hooks.tellsDepth = [fitter](const field::Aspect&, std::uint64_t) {
        return fitter->tellsDepth();
    };
    hooks.depthSeen = [fitter, span](std::uint64_t, float min, float max) {
        fitter->depthSeen(span(min, max));
    };
    hooks.log = [log](net::LogLevel level, const std::string& text) { log(level, text); };
    return hooks;
}

void ServerLink::connectNew() {
    std::vector<net::ServerAddress> fresh;
    {
        const std::lock_guard lock{mutex_};
        fresh.swap(listening_);
    }
    for (auto& address : fresh) {
        listened_.insert(address.name);
        hub_.connect(std::move(address));
    }
}

Result<void> ServerLink::start(field::ChangeList everything,
                               const Application::StatusCallback& progress,
                               const std::function<bool()>& keepGoing) {
    const auto deadline = Clock::now() + sync_.startTimeout;
    hub_.frame(std::move(everything), 0.0);
    for (const auto& address : remote_) hub_.connect(address);
    while (true) {
        connectNew();
        if (launcher_) {
            if (auto healthy = launcher_->health(); !healthy) return healthy;
        }
        if (keepGoing && !keepGoing()) return fail(Errc::timeout, "given up while starting");
        if (auto fit = startedFit(); !fit) return fit;
        const auto slice = Clock::now() + 100ms;
        const auto joined = hub_.waitForAll(progress, slice);
        if (joined && listened_.size() >= launched_) break;
        if (Clock::now() >= deadline) return joined ? silentServers() : joined;
        if (!joined) continue;
        // Everybody known takes part; the others have not said their port yet.
        std::unique_lock lock{mutex_};
        listens_.wait_until(lock, slice, [&] { return !listening_.empty(); });
    }
    if (launcher_) launcher_->startupDone();
    return {};
}

/// Servers started from here would only be started again as they are. Those that run already may
/// be put right meanwhile by whoever runs them.
Result<void> ServerLink::startedFit() const {
    for (const auto& server : hub_.status())
        if (server.unfit && listened_.contains(server.address.name))
            return fail(Errc::protocol, server.text);
    return {};
}

Result<void> ServerLink::silentServers() const {
    return fail(Errc::timeout,
                fmt::format("{} of {} servers that were started did not say their port within "
                            "{:.0f} s",
                            launched_ - listened_.size(), launched_,
                            std::chrono::duration<double>(sync_.startTimeout).count()));
}

net::FrameResult ServerLink::frame(field::ChangeList changes, double time, bool capture) {
    connectNew();
    return hub_.frame(std::move(changes), time, capture);
}

std::vector<int> ServerLink::processes() const {
    return launcher_ ? launcher_->processes() : std::vector<int>{};
}

void ServerLink::shutdown() {
    ending_ = true;
    hub_.shutdown();
    if (launcher_) launcher_->stop();
}

}  // namespace gnomon::client
