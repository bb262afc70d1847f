#include "Options.h"

#include <gnomon/net/Lookup.h>

#include <CLI/CLI.hpp>

namespace gnomon::server {

bool parseOptions(int argc, char** argv, Options& options, int& exitCode) {
    CLI::App program{"Renders the windows of one server of a Gnomon wall.", "gnomon-server"};
    std::string listen = "127.0.0.1:0";
    program.add_option("--name", options.name, "name in the wall's configuration")->required();
    program.add_option("--listen", listen, "ADDR:PORT to listen at; port 0 is any free one")
        ->capture_default_str();
    program.add_option("--backend", options.backend, "egl, osmesa, glfw, none or auto")
        ->check(CLI::IsMember({"egl", "osmesa", "glfw", "none", "auto"}))
        ->capture_default_str();
    program.add_option("--gpu", options.gpu,
                       "GPU to render on, as the system counts them; -1: any");
    program.add_option("--key", options.key,
                       "cluster key (gnomon keygen): only who has it may connect; without one, and "
                       "none in ~/.config/gnomon/cluster.key, only this machine may");
    auto* announce =
        program
            .add_option("--announce", options.announce,
                        "tell who looks up the name where the server is, on the interfaces that it "
                        "listens on; GROUP:PORT is the wall's cluster.lookup (default: " +
                            std::string{net::defaultLookupGroup} + ")")
            ->type_name("[GROUP:PORT]")
            ->expected(0, 1);
    program.add_flag("--exit-with-input", options.exitWithInput,
                     "end when standard input does (servers started from another machine)");
    program.add_flag("--exit-with-client", options.exitWithClient,
                     "end when the client goes away (local walls)");
    try {
        program.parse(argc, argv);
        if (announce->count() > 0 && options.announce.empty())
            options.announce = net::defaultLookupGroup;
        if (!options.announce.empty())
            if (const auto group = net::parseLookupGroup(options.announce); !group)
                throw CLI::ValidationError("--announce", group.error().what);
        const auto colon = listen.rfind(':');
        std::size_t used = 0;
        if (colon == std::string::npos || colon + 1 == listen.size())
            throw CLI::ValidationError("--listen", "\"" + listen + "\", expected ADDR:PORT");
        const std::string digits = listen.substr(colon + 1);
        const bool number =
            digits.find_first_not_of("0123456789") == std::string::npos && digits.size() <= 5;
        const unsigned long port = number ? std::stoul(digits, &used) : 65536UL;
        if (port > 65535)
            throw CLI::ValidationError("--listen", "port \"" + digits + "\", expected 0 to 65535");
        options.address = listen.substr(0, colon);
        options.port = static_cast<std::uint16_t>(port);
    } catch (const CLI::CallForHelp& help) {
        exitCode = program.exit(help);
        return false;
    } catch (const CLI::ParseError& error) {
        program.exit(error);
        exitCode = 2;
        return false;
    }
    return true;
}

}  // namespace gnomon::server
