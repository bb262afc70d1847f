// What a cluster costs without the drawing: frames, bulk data and the first sync, against the
// number of servers. Every server is a process of its own on this machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "Cases.h"

int main(int argc, char** argv) {
    using namespace gnomon::bench;
    CLI::App program{"Measures a cluster of null-render servers on this machine.",
                     "gnomon-cluster-bench"};
    ClusterOptions options;
    std::vector<std::string> cases{"idle", "100", "10000", "bulk", "sync"};
    std::vector<int> servers{1, 8};
    double seconds = 2;
    program.add_option("--program", options.program, "gnomon-server")->required();
    program.add_option("--cases", cases, "idle, bulk, sync, or a number of transforms that change")
        ->delimiter(',');
    program.add_option("--servers", servers, "numbers of servers")->delimiter(',');
    program.add_option("--seconds", seconds, "for each case");
    program.add_option("--pipeline", options.pipeline, "frames the client runs ahead, 0 to 2")
        ->capture_default_str();
    program
        .add_option("--relay", options.relay,
                    "servers anyone sends payloads to; 0: the client sends to all")
        ->capture_default_str();
    program.add_option("--key", options.key, "cluster key: with TLS");
    CLI11_PARSE(program, argc, argv);
    try {
        for (const std::string& name : cases) {
            for (const int count : servers) {
                options.servers = count;
                const Row row = measure(name, options, seconds);
                // A line of JSON each: scripts/bench-net makes tables of them.
                fmt::print("{}\n", nlohmann::json{{"case", row.name},
                                                  {"servers", row.servers},
                                                  {"pipeline", row.pipeline},
                                                  {"relay", row.relay},
                                                  {"tls", row.tls},
                                                  {"samples", row.samples},
                                                  {"median_us", row.median},
                                                  {"p99_us", row.p99},
                                                  {"bytes", row.bytes}}
                                       .dump());
                std::fflush(stdout);
            }
        }
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "gnomon-cluster-bench: %s\n", failure.what());
        return 1;
    }
    return 0;
}
