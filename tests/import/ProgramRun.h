#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::importer {

/// How a run of gnomon-import ended.
struct ProgramRun {
    int code = -1;  ///< exit code; -1: ended by a signal
    int signal = 0;
    std::string errors = {};
    std::uint64_t outputBytes = 0;
    std::uint64_t peakBytes = 0;  ///< largest resident size
    double seconds = 0.0;
};

/// Runs the importer that was built with these tests, for at most 60 s.
ProgramRun runImporter(std::vector<std::string> arguments);

}  // namespace gnomon::importer
