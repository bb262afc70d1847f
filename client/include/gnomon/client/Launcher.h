#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/client/Log.h>
#include <gnomon/config/Config.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::client {

/// One server as a process on this machine, or the process that keeps it running on another one.
struct LaunchCommand {
    std::string server = {};                    ///< its name
    std::string host = "127.0.0.1";             ///< where it will listen
    std::vector<std::string> arguments = {};    ///< arguments[0] is the program
    std::vector<std::string> environment = {};  ///< `NAME=value`, added to ours

    /// As it would be typed.
    std::string text() const;
};

struct LaunchSettings {
    std::filesystem::path program = {};  ///< of local servers; empty: beside the running program
    std::string backend = "auto";
    unsigned cores = 1;  ///< threads that can run at once here; local servers share them
    std::filesystem::path key = {};     ///< cluster key of local servers; empty: none
    std::filesystem::path farKey = {};  ///< of those on other machines; empty: their usual one
};

/// What is started for a config: its local servers and, where it says how, those elsewhere.
std::vector<LaunchCommand> launchCommands(const config::Config& config,
                                          const LaunchSettings& settings);

/// What local servers find in their environment unless the user's says otherwise: their heap lies
/// in pages of 2 MiB where the system has them. To fault in a scene in pages of 4 KiB takes longer
/// than to build it, most of all in a virtual machine.
std::vector<std::string> serverEnvironment();

/// Worker threads of Mesa's software rasterizer for each of @p servers on @p cores: 0 (everything
/// in the server's own thread) where there are as many servers as cores.
unsigned rasterizerThreads(unsigned servers, unsigned cores) noexcept;

struct LauncherOptions {
    std::vector<LaunchCommand> commands = {};
    LogCallback log = {};  ///< also the servers' own lines, each with the server's name before it
    /// A server listens on this port of its host, for the first time or again. On the launcher's
    /// thread.
    std::function<void(const std::string& server, std::uint16_t port)> listening = {};
};

/// Starts servers all at once, starts one again that dies (after 100 ms, doubling to 5 s),
/// and ends them all with itself. They also end with this process, however it ends: a thread of
/// the launcher's own is their parent for as long as it lives.
class Launcher {
public:
    explicit Launcher(LauncherOptions options);
    /// As stop().
    ~Launcher();
    Launcher(const Launcher&) = delete;
    Launcher& operator=(const Launcher&) = delete;

    /// While starting: a server that ended by itself, or was killed three times, as an error with
    /// its own last line. Nothing else is an error.
    Result<void> health() const;
    /// From now on a server that ends is started again whatever it said.
    void startupDone();
    /// Process ids, in the order of the commands; -1 where it is not running.
    std::vector<int> processes() const;
    /// Asks all to end, waits up to two seconds, then kills. Returns when none is left.
    void stop();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::client
