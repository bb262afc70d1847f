#include <fmt/format.h>

#include <map>
#include <tuple>

#include "Checks.h"
#include "Grid.h"
#include "Subject.h"
#include "Text.h"

namespace gnomon::config {
namespace {

std::string elsewhere(const Place& place) {
    return place.line == 0 ? std::string{} : fmt::format(" (line {})", place.line);
}

// Servers and screens alike: each name once.
template <class T>
void checkNames(const std::vector<T>& all, const char* kind, std::vector<Finding>& findings) {
    std::map<std::string_view, const T*> first;
    for (const T& item : all) {
        const auto [it, isNew] = first.emplace(item.name, &item);
        if (isNew) continue;
        findings.push_back(
            {.place = item.origin.of("name"),
             .what = fmt::format("{}: there is another {} of that name{}, each needs its own",
                                 subject(item), kind, elsewhere(it->second->origin.of("name")))});
    }
}

}  // namespace

void checkServers(const Config& config, std::vector<Finding>& findings) {
    const Place& top = config.origin.table;
    if (config.screens.empty()) {
        findings.push_back({.place = top, .what = "no [[screen]], a wall has at least one"});
    }
    if (config.servers.empty()) {
        findings.push_back(
            {.place = top, .what = "no [[server]] or [[server_grid]], a wall has at least one"});
    }
    if (config.servers.size() > maxServers) {
        findings.push_back({.place = config.servers[maxServers].origin.table,
                            .what = fmt::format("{} servers, a wall has at most {}",
                                                config.servers.size(), maxServers)});
    }
    checkNames(config.screens, "screen", findings);
    checkNames(config.servers, "server", findings);

    std::map<std::pair<std::string, int>, const Server*> ports;
    std::map<std::tuple<std::string, int, int>, const Server*> monitors;
    for (const Server& server : config.servers) {
        // All names of this machine are one.
        const std::string host = isLocal(server.host) ? "localhost" : server.host;
        if (server.port != 0) {
            const auto [it, isNew] = ports.emplace(std::pair{host, server.port}, &server);
            if (!isNew) {
                findings.push_back(
                    {.place =
                         server.origin.of(server.origin.keys.contains("port") ? "port" : "host"),
                     .what = fmt::format("{}: {} port {} is taken by server {}, each needs its own",
                                         subject(server), server.host, server.port,
                                         tomlText(it->second->name))});
            }
        }
        for (const Window& window : server.windows) {
            if (!window.fullscreen || isLookedUp(server)) continue;
            const auto [it, isNew] =
                monitors.emplace(std::tuple{host, gpuOf(server, window), window.monitor}, &server);
            if (isNew) continue;
            findings.push_back(
                {.level = Level::warning,
                 .place = window.origin.of("fullscreen"),
                 .what = fmt::format("{}: full screen on monitor {} of gpu {} of {}, which server "
                                     "{} fills already",
                                     subject(server), window.monitor, gpuOf(server, window),
                                     server.host, tomlText(it->second->name))});
        }
    }
}

}  // namespace gnomon::config
