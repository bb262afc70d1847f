#include <fmt/format.h>
#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <set>

#include "Commands.h"

namespace gnomon::client {
namespace {

struct CheckOptions {
    std::string config = {};
    std::string svg = {};
    bool hosts = false;
};

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
    command.callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace gnomon::client
