// What a cluster costs without the drawing: frames, bulk data and the first sync, against the
// number of servers. Every server is a process of its own on this machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "Cases.h"
#include "GrowthPlot.h"

namespace {

std::vector<std::pair<int, int>> pairs(const std::vector<int>& one, const std::vector<int>& other) {
    std::vector<std::pair<int, int>> all;
    for (const int a : one)
        for (const int b : other) all.emplace_back(a, b);
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace gnomon::bench;
    CLI::App program{"Measures a cluster of null-render servers on this machine.",
                     "gnomon-cluster-bench"};
    ClusterOptions options;
    std::vector<std::string> cases{"floor", "idle", "100", "10000", "bulk", "sync"};
    std::vector<int> servers{1, 8};
    std::vector<int> relays{0};
    double seconds = 2;
    program.add_option("--program", options.program, "gnomon-server")->required();
    program
        .add_option("--cases", cases,
                    "floor, idle, bulk, sync, or a number of transforms that change")
        ->delimiter(',');
    program.add_option("--servers", servers, "numbers of servers")->delimiter(',');
    program.add_option("--seconds", seconds, "for each case");
    program.add_option("--pipeline", options.pipeline, "frames the client runs ahead, 0 to 2")
        ->capture_default_str();
    program
        .add_option("--relay", relays,
                    "servers anyone sends payloads to; 0: the client sends to all")
        ->delimiter(',');
    program.add_option("--key", options.key, "cluster key: with TLS");
    std::string plot;
    program.add_option("--plot", plot, "SVG: time against servers");
    CLI11_PARSE(program, argc, argv);
    try {
        std::vector<Row> rows;
        for (const std::string& name : cases) {
            for (const auto& [count, relay] : pairs(servers, relays)) {
                if (relay > 0 && name != "bulk" && name != "sync") continue;  // it changes nothing
                options.servers = count;
                options.relay = relay;
                const Row row = measure(name, options, seconds);
                rows.push_back(row);
                fmt::print(stderr, "{}\n",
                           nlohmann::json{{"case", row.name},
                                          {"servers", row.servers},
                                          {"pipeline", row.pipeline},
                                          {"relay", row.relay},
                                          {"tls", row.tls},
                                          {"samples", row.samples},
                                          {"median_us", row.median},
                                          {"p99_us", row.p99},
                                          {"bytes", row.bytes}}
                               .dump());
            }
        }
        fmt::print("{}", markdown(rows));
        if (!plot.empty() && !(std::ofstream{plot} << growthSvg(rows)))
            throw gnomon::Failure{gnomon::Errc::file, plot + ": cannot be written"};
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "gnomon-cluster-bench: %s\n", failure.what());
        return 1;
    }
    return 0;
}
