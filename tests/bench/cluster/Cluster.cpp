#include "Cluster.h"

#include <fmt/format.h>
#include <gnomon/scene/Types.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>

namespace gnomon::bench {
namespace {

using namespace std::chrono_literals;

auto in(std::chrono::seconds span) { return std::chrono::steady_clock::now() + span; }

/// What the launcher tells, on its own thread.
struct Heard {
    std::mutex mutex = {};
    std::condition_variable changed = {};
    std::vector<net::ServerAddress> servers = {};
    std::string last = {};
};

}  // namespace

Cluster::Cluster(const ClusterOptions& options) {
    scene::addTypes(types_);
    std::vector<client::LaunchCommand> commands;
    for (int i = 0; i < options.servers; ++i) {
        const auto name = fmt::format("server{}", i);
        client::LaunchCommand command{.server = name,
                                      .arguments = {options.program, "--name", name, "--backend",
                                                    "none", "--exit-with-client"},
                                      .environment = client::serverEnvironment()};
        if (!options.key.empty()) {
            command.arguments.emplace_back("--key");
            command.arguments.push_back(options.key);
        }
        commands.push_back(std::move(command));
    }
    const auto heard = std::make_shared<Heard>();
    client::LauncherOptions launch{.commands = std::move(commands)};
    launch.log = [heard](client::LogLevel, const std::string& text) {
        const std::lock_guard lock{heard->mutex};
        heard->last = text;
    };
    launch.listening = [heard](const std::string& server, std::uint16_t port) {
        const std::lock_guard lock{heard->mutex};
        heard->servers.push_back({.name = server, .host = "127.0.0.1", .port = port});
        heard->changed.notify_all();
    };
    launcher_ = std::make_unique<client::Launcher>(std::move(launch));
    {
        std::unique_lock lock{heard->mutex};
        const auto count = static_cast<std::size_t>(options.servers);
        if (!heard->changed.wait_until(lock, in(120s),
                                       [&] { return heard->servers.size() == count; }))
            throw Failure{Errc::timeout, fmt::format("{} of {} servers listen; last words: {}",
                                                     heard->servers.size(), count, heard->last)};
        addresses_ = heard->servers;
    }
    net::SharedKey key;
    if (!options.key.empty())
        key = std::make_shared<const net::ClusterKey>(orThrow(net::ClusterKey::load(options.key)));
    hub_ = std::make_unique<net::ClientHub>(
        types_,
        net::SyncOptions{
            .timeout = 20s, .pipeline = options.pipeline, .digestEvery = 0, .relay = options.relay},
        net::HubHooks{.log =
                          [](net::LogLevel level, const std::string& text) {
                              // That there is nothing to draw is meant.
                              if (text.find("no window of the scene") != std::string::npos) return;
                              if (level >= net::LogLevel::warning)
                                  std::fprintf(stderr, "%s\n", text.c_str());
                          }},
        key);
}

void Cluster::join() {
    for (const auto& address : addresses_) hub_->connect(address);
    orThrow(hub_->waitForAll({}, in(120s)));
}

}  // namespace gnomon::bench
