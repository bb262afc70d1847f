#include <fmt/format.h>
#include <gnomon/base/Process.h>
#include <gnomon/client/Launcher.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace gnomon::client {
namespace {

using Words = std::vector<std::string>;

/// Quoted for a shell where it needs to be.
std::string quoted(const std::string& word) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view{"-_=.,:/+@%"}.find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return result + "'";
}

std::string quoted(const Words& words) {
    std::string line;
    for (const auto& word : words) line += (line.empty() ? "" : " ") + quoted(word);
    return line;
}

/// What the server itself is told.
Words serverWords(const config::Server& server, const std::string& program,
                  const std::string& address, const LaunchSettings& settings,
                  const std::filesystem::path& key) {
    Words words{program,
                "--name",
                server.name,
                "--listen",
                fmt::format("{}:{}", address, server.port),
                "--backend",
                settings.backend};
    const auto add = [&](const char* option, std::string value) {
        words.emplace_back(option);
        words.push_back(std::move(value));
    };
    if (server.gpu >= 0) add("--gpu", std::to_string(server.gpu));
    if (!key.empty()) add("--key", key.string());
    return words;
}

/// The same through a starter of programs on other machines. The server ends with its input, which
/// ends with the starter, however that ends.
Words farWords(const config::Cluster& cluster, const config::Server& server,
               const LaunchSettings& settings) {
    const bool isV6 = server.host.find(':') != std::string::npos;
    Words inner =
        serverWords(server, cluster.server, isV6 ? "::" : "0.0.0.0", settings, settings.farKey);
    inner.emplace_back("--exit-with-input");
    Words words{cluster.launch == config::Launch::ssh     ? "ssh"
                : cluster.launch == config::Launch::slurm ? "srun"
                                                          : "mpirun"};
    const auto add = [&](const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
    };
    add(cluster.options);
    switch (cluster.launch) {
        case config::Launch::ssh:
            // Asks nobody for a password; the other side's shell splits the last word again.
            add({"-o", "BatchMode=yes", "-o", "ConnectTimeout=10", server.host});
            words.push_back("exec " + quoted(inner));
            break;
        case config::Launch::slurm:
            add({"--nodelist=" + server.host, "--nodes=1", "--ntasks=1", "--overlap",
                 "--unbuffered"});
            add(inner);
            break;
        case config::Launch::mpi:
            add({"--host", server.host, "-n", "1"});
            add(inner);
            break;
        case config::Launch::none:
            break;
    }
    return words;
}

}  // namespace

std::string LaunchCommand::text() const {
    return quoted(environment) + (environment.empty() ? "" : " ") + quoted(arguments);
}

std::vector<std::string> serverEnvironment() {
    if (std::getenv("GLIBC_TUNABLES") != nullptr) return {};
    return {"GLIBC_TUNABLES=glibc.malloc.hugetlb=1"};
}

unsigned rasterizerThreads(unsigned servers, unsigned cores) noexcept {
    return servers == 0 || servers >= cores ? 0 : cores / servers;
}

std::vector<LaunchCommand> launchCommands(const config::Config& config,
                                          const LaunchSettings& settings) {
    const std::string program =
        (settings.program.empty() ? programFolder() / "gnomon-server" : settings.program).string();
    std::vector<LaunchCommand> commands;
    for (const auto& server : config.servers) {
        if (config::isLocal(server.host))
            commands.push_back(
                {.server = server.name,
                 .arguments = serverWords(server, program, "127.0.0.1", settings, settings.key)});
        else if (config.cluster.launch != config::Launch::none && !config::isLookedUp(server))
            commands.push_back({.server = server.name,
                                .host = server.host,
                                .arguments = farWords(config.cluster, server, settings)});
    }
    for (auto& command : commands)
        if (command.host == LaunchCommand{}.host) command.environment = serverEnvironment();
    // Someone who set it knows better.
    if (std::getenv("LP_NUM_THREADS") == nullptr) {
        const auto isLocal = [](const LaunchCommand& command) {
            return command.host == LaunchCommand{}.host;
        };
        const auto local = std::count_if(commands.begin(), commands.end(), isLocal);
        const unsigned threads = rasterizerThreads(static_cast<unsigned>(local), settings.cores);
        for (auto& command : commands)
            if (isLocal(command))
                command.environment.push_back(fmt::format("LP_NUM_THREADS={}", threads));
    }
    return commands;
}

}  // namespace gnomon::client
