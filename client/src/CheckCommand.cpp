#include <fmt/format.h>
#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>
#include <gnomon/net/Probe.h>

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

/// Every host once, in the order of the file: what a shell loop over machines needs.
void printHosts(const config::Config& wall) {
    std::set<std::string> seen;
    for (const auto& server : wall.servers)
        if (seen.insert(server.host).second) fmt::print("{}\n", server.host);
}

/// Whether the servers on other machines are there and have the key: a line each.
int reach(const config::Config& wall, const CheckOptions& options) {
    const auto key = orThrow(loadKey(orThrow(findKeyFile(wall, {.key = options.key}))));
    std::vector<net::ServerAddress> servers;
    for (const auto& server : wall.servers)
        if (!config::isLocal(server.host))
            servers.push_back({.name = server.name,
                               .host = server.host,
                               .port = static_cast<std::uint16_t>(server.port)});
    const auto answers = net::probe(servers, key, patience);
    std::size_t silent = 0;
    for (std::size_t i = 0; i < servers.size(); ++i) {
        if (!answers[i]) ++silent;
        fmt::print("{} ({}:{}): {}\n", servers[i].name, servers[i].host, servers[i].port,
                   answers[i] ? "is there, and has the key" : answers[i].error().text());
    }
    if (silent > 0)
        throw Failure{Errc::disconnected, fmt::format("{} of {} servers on other machines cannot "
                                                      "be used",
                                                      silent, servers.size())};
    if (servers.empty()) fmt::print("no server is on another machine\n");
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
                     "Ask the servers on other machines whether they are there and have the key");
    command.add_option("--key", options->key, "Cluster key, instead of the config's")
        ->type_name("FILE");
    command.callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace gnomon::client
