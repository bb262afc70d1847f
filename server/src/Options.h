#pragma once

#include <cstdint>
#include <string>

namespace gnomon::server {

/// The command line of gnomon-server.
struct Options {
    std::string name = {};  ///< the server's name in the wall's config
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;        ///< 0: any free one; reported on standard output
    std::string backend = "auto";  ///< egl osmesa glfw none auto
    int gpu = -1;
    std::string key = {};       ///< cluster key file; empty: the usual one, where one is needed
    std::string announce = {};  ///< GROUP:PORT where the name can be looked up; empty: it cannot
    bool exitWithClient = false;
    bool exitWithInput = false;
};

/// Parses; where it cannot, or only help was asked for, says so and sets @p exitCode.
bool parseOptions(int argc, char** argv, Options& options, int& exitCode);

}  // namespace gnomon::server
