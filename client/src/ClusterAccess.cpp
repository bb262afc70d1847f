#include "ClusterAccess.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace gnomon::client {

Result<KeyFile> findKeyFile(const config::Config& config, const ApplicationOptions& options) {
    if (!options.key.empty()) return KeyFile{.file = std::filesystem::absolute(options.key)};
    if (config.cluster.key)
        return KeyFile{.file = std::filesystem::absolute(config::keyPath(config.cluster))};
    const auto& servers = config.servers;
    if (std::all_of(servers.begin(), servers.end(),
                    [](const config::Server& server) { return config::isLocal(server.host); }))
        return KeyFile{};
    const auto usual = net::defaultKeyFile();
    std::error_code ec;
    if (!usual.empty() && std::filesystem::exists(usual, ec))
        return KeyFile{.file = usual, .usual = true};
    const auto far = std::find_if(servers.begin(), servers.end(), [](const config::Server& server) {
        return !config::isLocal(server.host) && !config::isLookedUp(server);
    });
    if (far == servers.end()) return KeyFile{};
    return fail(Errc::config,
                fmt::format("{}server \"{}\" is on {}: other computers are only spoken to with a "
                            "cluster key, and there is no {}; make one with gnomon keygen and copy "
                            "it to every machine, or use --local",
                            far->origin.of("host").prefix(), far->name, far->host,
                            usual.empty() ? std::string{"home folder"} : usual.string()));
}

Result<net::SharedKey> loadKey(const KeyFile& file) {
    if (file.file.empty()) return net::SharedKey{};
    auto key = net::ClusterKey::load(file.file);
    if (!key) return tl::unexpected{std::move(key).error()};
    return std::make_shared<const net::ClusterKey>(*std::move(key));
}

net::ServerAddress addressOf(const config::Config& config, const config::Server& server) {
    net::ServerAddress address{
        .name = server.name, .host = server.host, .port = static_cast<std::uint16_t>(server.port)};
    if (config::isLookedUp(server)) address.lookup = config.cluster.lookup.value();
    return address;
}

std::vector<LaunchCommand> launchCommands(const config::Config& config,
                                          const ApplicationOptions& options, const KeyFile& key) {
    return launchCommands(config, {.program = options.server,
                                   .backend = options.backend,
                                   .cores = std::max(1U, std::thread::hardware_concurrency()),
                                   .key = key.file,
                                   .farKey = key.usual ? std::filesystem::path{} : key.file});
}

}  // namespace gnomon::client
