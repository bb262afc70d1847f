#include <fmt/format.h>
#include <gnomon/base/Process.h>
#include <gnomon/client/Launcher.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace gnomon::client {
namespace {

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

}  // namespace

std::string LaunchCommand::text() const {
    std::string line;
    for (const auto& variable : environment) line += quoted(variable) + " ";
    for (const auto& argument : arguments)
        line += quoted(argument) + (&argument == &arguments.back() ? "" : " ");
    return line;
}

unsigned rasterizerThreads(unsigned servers, unsigned cores) noexcept {
    return servers == 0 || servers >= cores ? 0 : cores / servers;
}

std::vector<LaunchCommand> launchCommands(const config::Config& config,
                                          const std::filesystem::path& program,
                                          std::string_view backend, unsigned cores) {
    const std::string path =
        (program.empty() ? programFolder() / "gnomon-server" : program).string();
    std::vector<LaunchCommand> commands;
    for (const auto& server : config.servers) {
        if (!config::isLocal(server.host)) continue;
        LaunchCommand command{.server = server.name};
        command.arguments = {path,
                             "--name",
                             server.name,
                             "--listen",
                             fmt::format("127.0.0.1:{}", server.port),
                             "--backend",
                             std::string{backend}};
        if (server.gpu >= 0) {
            command.arguments.emplace_back("--gpu");
            command.arguments.push_back(std::to_string(server.gpu));
        }
        commands.push_back(std::move(command));
    }
    // Someone who set it knows better.
    if (std::getenv("LP_NUM_THREADS") == nullptr) {
        const unsigned threads = rasterizerThreads(static_cast<unsigned>(commands.size()), cores);
        for (auto& command : commands)
            command.environment.push_back(fmt::format("LP_NUM_THREADS={}", threads));
    }
    return commands;
}

}  // namespace gnomon::client
