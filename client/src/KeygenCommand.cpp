#include <fmt/format.h>
#include <gnomon/net/ClusterKey.h>

#include <memory>

#include "Commands.h"

namespace gnomon::client {
namespace {

int keygen(std::filesystem::path file) {
    if (file.empty()) file = net::defaultKeyFile();
    if (file.empty())
        throw Failure{Errc::config, "there is no home folder to write the key to, use --out FILE"};
    const auto key = net::ClusterKey::random();
    orThrow(key.save(file));
    fmt::print("wrote {}, fingerprint {}\n", file.string(), key.fingerprint());
    fmt::print("copy it to every machine of the cluster, readable by its owner alone\n");
    return 0;
}

}  // namespace

void addKeygen(CLI::App& program, Action& action) {
    auto& command = *program.add_subcommand(
        "keygen", "Make the secret that the machines of a cluster share; never overwrites one");
    const auto file = std::make_shared<std::string>();
    command.add_option("--out", *file, "Where to; default: ~/.config/gnomon/cluster.key")
        ->type_name("FILE");
    command.callback([file, &action] { action = [file] { return keygen(*file); }; });
}

}  // namespace gnomon::client
