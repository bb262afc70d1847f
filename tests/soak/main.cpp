// gnomon-soak: a wall of null-render servers through many frames, edits, kills and returns, and
// what it costs in memory and descriptors.
#include <fmt/format.h>
#include <gnomon/base/Process.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "Soak.h"

namespace {

using gnomon::soak::Outcome;
using gnomon::soak::Sample;

void print(const Outcome& outcome) {
    fmt::print("{} frames in {:.0f} s, median {:.2f} ms, longest {:.0f} ms\n", outcome.frames,
               outcome.seconds, outcome.medianMs, outcome.longestMs);
    fmt::print("{} faults: servers lost {} times, back {} times; drifts {}\n", outcome.faults,
               outcome.lost, outcome.rejoined, outcome.drifts);
    fmt::print("{:>9} {:>8} {:>12} {:>6} {:>12} {:>6} {:>12} {:>6} {:>7} {:>8}\n", "frame", "s",
               "client KiB", "files", "server KiB", "files", "largest KiB", "files", "things",
               "zombies");
    const auto& samples = outcome.samples;
    const std::size_t step = std::max<std::size_t>(samples.size() / 10, 1);
    for (std::size_t i = step - 1; i < samples.size(); i += step) {
        const Sample& at = samples[i];
        fmt::print("{:>9} {:>8.1f} {:>12} {:>6} {:>12} {:>6} {:>12} {:>6} {:>7} {:>8}\n", at.frame,
                   at.s, at.clientKib, at.clientFiles, at.serverKib, at.serverFiles, at.mostKib,
                   at.mostFiles, at.things, at.zombies);
    }
    fmt::print("files of the client: {} before, {} after; processes left: {}\n",
               outcome.filesBefore, outcome.filesAfter, outcome.children);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program{"Soaks a wall of null-render servers in edits, kills and returns",
                     "gnomon-soak"};
    gnomon::soak::SoakOptions options;
    program.add_option("WALL", options.wall, "The wall, a TOML file")->required();
    program.add_option("--frames", options.frames, "How many")->capture_default_str();
    program.add_option("--fault-every", options.faultEvery, "Frames from one fault to the next")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    program.add_option("--changes", options.changes, "Edits each frame")->capture_default_str();
    program.add_option("--timeout", options.timeout, "sync.timeout, seconds")
        ->capture_default_str();
    program.add_option("--seed", options.seed, "Decides what happens")->capture_default_str();
    program.add_option("--csv", options.csv, "All that was measured")->type_name("FILE");
    CLI11_PARSE(program, argc, argv);
    try {
        options.server = gnomon::programFolder() / "gnomon-server";
        const auto outcome = gnomon::soak::soak(options);
        print(outcome);
        const auto wrong = gnomon::soak::complaints(outcome);
        for (const auto& line : wrong) std::fprintf(stderr, "gnomon-soak: %s\n", line.c_str());
        return wrong.empty() ? 0 : 1;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "gnomon-soak: %s\n", failure.what());
        return 1;
    }
}
