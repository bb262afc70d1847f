#pragma once

#include <gnomon/base/Error.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon::importer {

/// The command line of gnomon-import.
struct ProgramOptions {
    std::filesystem::path file = {};
    std::string output = {};  ///< a file descriptor's number, "-" or a path
    std::uint64_t maxMemory = std::uint64_t{4} << 30U;  ///< address space, bytes
    std::uint32_t maxTime = 60;                         ///< seconds
    bool progress = false;
    bool help = false;
};

Result<ProgramOptions> parsedOptions(int count, const char* const* arguments);
std::string usage();

}  // namespace gnomon::importer
