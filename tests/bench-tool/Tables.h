#pragma once

#include "bench/Table.h"

namespace gnomon::client {

inline BenchRow row(const std::string& technique, int mapSize, double ms, std::uint64_t wrong) {
    return {.technique = technique,
            .mapSize = mapSize,
            .frameMs = {.median = ms, .low = ms * 0.9, .high = ms * 1.1},
            .ratio = {.median = ms / 10.0, .low = ms * 0.09, .high = ms * 0.11},
            .error = {.counted = 1000, .wrong = wrong}};
}

/// Five techniques, of which `slow` is beaten, in a scene whose name is no XML.
inline BenchTable table() {
    return {
        .scene = "a<b>&c.obj",
        .view = "side, \"low\"",
        .renderer = "a renderer",
        .width = 64,
        .height = 48,
        .frames = 50,
        .rows = {row("none", 512, 10.0, 50), row("std", 512, 12.0, 20), row("lispsm", 512, 12.5, 5),
                 row("slow", 512, 20.0, 5), row("lispsm", 1024, 14.0, 0)}};
}

}  // namespace gnomon::client
