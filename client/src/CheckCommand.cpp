#include <fmt/format.h>
#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>
#include <gnomon/net/Lookup.h>
#include <gnomon/net/Probe.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <set>

#include "ClusterAccess.h"
#include "Commands.h"

namespace gnomon::client {
namespace {

struct CheckOptions {
    std::string config = {};
    std::string svg = {};
    bool hosts = false;
    bool reach = false;
    std::string key = {};
};

/// Long enough for a name server that thinks about it.
constexpr std::chrono::milliseconds patience{5000};

void writeSvg(const config::Config& wall, const std::string& file) {
    std::ofstream out{file, std::ios::binary};
    out << config::svg(wall);
    out.flush();
    if (!out)
        throw Failure{Error{.code = Errc::file,
                            .what = file + ": cannot be written",
                            .cause = {errno, std::generic_category()}}};
}

/// Every host that is named once, in the order of the file: what a shell loop over machines needs.
void printHosts(const config::Config& wall) {
    std::set<std::string> seen;
    for (const auto& server : wall.servers)
        if (!config::isLookedUp(server) && seen.insert(server.host).second)
            fmt::print("{}\n", server.host);
}

/// Where the servers are that are looked up, a line each; nothing where one is not found.
std::vector<net::ServerAddress> found(const config::Config& wall, bool hasKey) {
    std::vector<std::string> names;
    for (const auto& server : wall.servers)
        if (config::isLookedUp(server)) names.push_back(server.name);
    std::vector<net::ServerAddress> all;
    if (names.empty()) return all;
    const auto& group = wall.cluster.lookup.value();
    const auto answers = net::lookUp(names, group, hasKey, patience);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto& [places, ms, trouble] = answers[i];
        if (places.empty())
            fmt::print("{}: not found: nobody answered on {} (udp){} within {} ms{}\n", names[i],
                       group, hasKey ? "" : ", on this machine, for there is no cluster key,",
                       patience.count(), trouble.empty() ? trouble : "; " + trouble);
        for (const auto& place : places)
            fmt::print("{}: found at {}:{} after {:.2f} ms\n", names[i], place.host, place.port,
                       ms);
        if (places.size() > 1)
            fmt::print("warning: {}: {} servers have this name, each needs its own\n", names[i],
                       places.size());
        all.insert(all.end(), places.begin(), places.end());
    }
    return all;
}

/// Whether the servers on other machines, and those that are looked up, are there and have the key:
/// a line each.
int reach(const config::Config& wall, const CheckOptions& options) {
    const auto key = orThrow(loadKey(orThrow(findKeyFile(wall, {.key = options.key}))));
    std::vector<net::ServerAddress> servers = found(wall, key != nullptr);
    for (const auto& server : wall.servers)
        if (!config::isLocal(server.host) && !config::isLookedUp(server))
            servers.push_back(addressOf(wall, server));
    const auto answers = net::probe(servers, key, patience);
    std::set<std::string> good;
    for (std::size_t i = 0; i < servers.size(); ++i) {
        if (answers[i]) good.insert(servers[i].name);
        fmt::print("{}: {}\n", net::labelOf(servers[i]),
                   !answers[i] ? answers[i].error().text()
                   : key       ? "is there, and has the key"
                               : "is there");
    }
    const auto asked = static_cast<std::size_t>(
        std::count_if(wall.servers.begin(), wall.servers.end(),
                      [](const config::Server& server) { return !config::isLocal(server.host); }));
    if (good.size() < asked)
        throw Failure{Errc::disconnected, fmt::format("{} of {} servers on other machines cannot "
                                                      "be used",
                                                      asked - good.size(), asked)};
    if (asked == 0) fmt::print("no server is on another machine\n");
    return 0;
}

int check(const CheckOptions& options) {
    const auto inspection = orThrow(config::inspectFile(options.config));
    if (config::hasError(inspection.findings)) {
        // All of them here; the program's own last line has the first one again.
        for (const auto& finding : inspection.findings) fmt::print("{}\n", finding.text());
        throw Failure{config::toError(inspection.findings)};
    }
    const config::Config& wall = *inspection.config;
    if (options.hosts) {
        printHosts(wall);
        return 0;
    }
    if (options.reach) return reach(wall, options);
    for (const auto& finding : inspection.findings) fmt::print("{}\n", finding.text());
    fmt::print("{}", config::describe(wall));
    if (!options.svg.empty()) writeSvg(wall, options.svg);
    return 0;
}

}  // namespace

void addCheck(CLI::App& program, Action& action) {
    auto& command =
        *program.add_subcommand("check", "Validate a wall's description, tell who shows what");
    const auto options = std::make_shared<CheckOptions>();
    command.add_option("CONFIG", options->config, "The wall, a TOML file")->required();
    command.add_option("--svg", options->svg, "Draw the wall into this file")->type_name("FILE");
    command.add_flag("--hosts", options->hosts, "Only the hosts, one a line");
    command.add_flag("--reach", options->reach,
                     "Look up the servers that have no host; ask these and those on other machines "
                     "whether they are there and have the key");
    command.add_option("--key", options->key, "Cluster key, instead of the config's")
        ->type_name("FILE");
    command.callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace gnomon::client
