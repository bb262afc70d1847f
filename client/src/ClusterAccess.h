#pragma once

#include <gnomon/client/Application.h>
#include <gnomon/net/ClusterKey.h>

namespace gnomon::client {

/// Which file holds the key of a wall.
struct KeyFile {
    std::filesystem::path file = {};  ///< empty: no key is needed, and none was named
    bool usual = false;               ///< nobody named it: every machine has its own in that place
};

/// The file named in the options, else in the config; else, where a server is on another machine,
/// the usual one. An error where that is missing, unless servers are looked up: then only those on
/// this machine are found.
Result<KeyFile> findKeyFile(const config::Config& config, const ApplicationOptions& options);

/// The key in that file; null where there is none.
Result<net::SharedKey> loadKey(const KeyFile& file);

/// Whether somebody else must have started that server.
inline bool isAwaited(const config::Config& config, const config::Server& server) {
    return config::isLookedUp(server) ||
           (config.cluster.launch == config::Launch::none && !config::isLocal(server.host));
}

/// Where it is, or where to ask for that.
net::ServerAddress addressOf(const config::Config& config, const config::Server& server);

/// What is started for a wall, with that key.
std::vector<LaunchCommand> launchCommands(const config::Config& config,
                                          const ApplicationOptions& options, const KeyFile& key);

}  // namespace gnomon::client
