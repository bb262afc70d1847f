#include <gnomon/client/Launcher.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <condition_variable>
#include <mutex>

namespace gnomon::client {
namespace {

using namespace std::chrono_literals;

/// A shell script in the place of a server.
LaunchCommand script(const std::string& name, const std::string& text) {
    return {.server = name, .arguments = {"/bin/sh", "-c", text}};
}

/// Prints the port, then stays until it is told to end.
const std::string good = "echo port 4711; echo ready >&2; exec sleep 1000";

/// Collects what a launcher says; waits for it with a deadline.
class Record {
public:
    LauncherOptions options(std::vector<LaunchCommand> commands) {
        LauncherOptions made{.commands = std::move(commands)};
        made.log = [this](LogLevel, const std::string& line) {
            const std::lock_guard lock{mutex_};
            lines_.push_back(line);
            changed_.notify_all();
        };
        made.listening = [this](const std::string& server, std::uint16_t port) {
            const std::lock_guard lock{mutex_};
            ports_.emplace_back(server, port);
            changed_.notify_all();
        };
        return made;
    }
    bool waitForPorts(std::size_t count) {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, 20s, [&] { return ports_.size() >= count; });
    }
    bool waitForLine(const std::string& part) {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, 20s, [&] {
            for (const auto& line : lines_)
                if (line.find(part) != std::string::npos) return true;
            return false;
        });
    }
    std::vector<std::pair<std::string, std::uint16_t>> ports() {
        const std::lock_guard lock{mutex_};
        return ports_;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> lines_;
    std::vector<std::pair<std::string, std::uint16_t>> ports_;
};

bool alive(int pid) { return ::kill(pid, 0) == 0; }

Error failureOf(const Launcher& launcher) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < deadline)
        if (const auto health = launcher.health(); !health) return health.error();
    return {};
}

TEST(Launcher, TellsPortsAndPassesLinesOn) {
    Record record;
    Launcher launcher{record.options({script("left", good), script("right", good)})};
    ASSERT_TRUE(record.waitForPorts(2));
    EXPECT_TRUE(record.waitForLine("left: ready"));
    EXPECT_TRUE(record.waitForLine("right: ready"));
    for (const auto& [server, port] : record.ports()) EXPECT_EQ(port, 4711);
    EXPECT_TRUE(launcher.health());
    const auto pids = launcher.processes();
    launcher.stop();
    for (const int pid : pids) EXPECT_FALSE(alive(pid));
}

TEST(Launcher, StartsAKilledServerAgain) {
    Record record;
    Launcher launcher{record.options({script("left", good)})};
    ASSERT_TRUE(record.waitForPorts(1));
    launcher.startupDone();
    const int first = launcher.processes()[0];
    ASSERT_GT(first, 0);
    ::kill(first, SIGKILL);
    ASSERT_TRUE(record.waitForPorts(2));
    EXPECT_NE(launcher.processes()[0], first);
    EXPECT_TRUE(record.waitForLine("signal 9"));
    EXPECT_TRUE(launcher.health());
}

TEST(Launcher, AServerThatCannotStartIsNamedWithItsLastLine) {
    Record record;
    Launcher launcher{record.options(
        {script("left", good), script("right", "echo one >&2; echo no display >&2; exit 3")})};
    const auto error = failureOf(launcher);
    EXPECT_EQ(error.what, "server \"right\" ended with exit code 3: no display");
}

TEST(Launcher, AProgramThatIsNotThereIsNamed) {
    Record record;
    Launcher launcher{
        record.options({{.server = "left", .arguments = {"/nowhere/gnomon-server"}}})};
    const auto error = failureOf(launcher);
    EXPECT_NE(error.what.find("/nowhere/gnomon-server"), std::string::npos);
    EXPECT_EQ(error.cause, std::errc::no_such_file_or_directory);
}

TEST(Launcher, ServersThatDoNotListenToReasonAreKilled) {
    Record record;
    Launcher launcher{
        record.options({script("left", "trap '' TERM; echo port 1; while :; do sleep 0.1; done")})};
    ASSERT_TRUE(record.waitForPorts(1));
    const int pid = launcher.processes()[0];
    const auto begun = std::chrono::steady_clock::now();
    launcher.stop();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, 10s);
    EXPECT_FALSE(alive(pid));
}

TEST(Launcher, OnlyTheFirstWholePortLineCounts) {
    Record record;
    Launcher launcher{record.options(
        {script("left",
                "echo port 99999; echo port; echo port 12x; printf 'port 4'; echo 2; echo port 7;"
                "exec sleep 1000")})};
    ASSERT_TRUE(record.waitForLine("left: port 7"));
    ASSERT_EQ(record.ports().size(), 1U);
    EXPECT_EQ(record.ports()[0].second, 42);
}

config::Config threeServers(config::Launch launch = config::Launch::none) {
    config::Config config;
    config.cluster.launch = launch;
    config.servers.push_back({.name = "left", .port = 7431, .gpu = 1});
    config.servers.push_back({.name = "far", .host = "wall01", .port = 7430});
    config.servers.push_back({.name = "it's right"});
    ::unsetenv("LP_NUM_THREADS");
    ::unsetenv("GLIBC_TUNABLES");
    return config;
}

TEST(LaunchCommands, AreWhatTheConfigAsksFor) {
    const auto commands = launchCommands(
        threeServers(), {.program = "/opt/gnomon-server", .backend = "egl", .cores = 8});
    ASSERT_EQ(commands.size(), 2U);
    EXPECT_EQ(commands[0].text(),
              "GLIBC_TUNABLES=glibc.malloc.hugetlb=1 LP_NUM_THREADS=4 "
              "/opt/gnomon-server --name left --listen 127.0.0.1:7431 --backend "
              "egl --gpu 1");
    EXPECT_EQ(commands[1].text(),
              "GLIBC_TUNABLES=glibc.malloc.hugetlb=1 LP_NUM_THREADS=4 "
              "/opt/gnomon-server --name 'it'\\''s right' --listen 127.0.0.1:0 "
              "--backend egl");
}

struct Far {
    config::Launch launch = config::Launch::none;
    const char* text = "";
};

class EveryLaunch : public testing::TestWithParam<Far> {};

TEST_P(EveryLaunch, StartsServersElsewhereAndHereInTheirOrder) {
    auto config = threeServers(GetParam().launch);
    config.cluster.server = "/opt/my wall/gnomon-server";
    config.cluster.options = {"-v"};
    const auto commands = launchCommands(config, {.program = "/opt/gnomon-server",
                                                  .backend = "egl",
                                                  .cores = 8,
                                                  .key = "/etc/a.key",
                                                  .farKey = "/etc/a.key"});
    ASSERT_EQ(commands.size(), 3U);
    EXPECT_EQ(commands[0].text(),
              "GLIBC_TUNABLES=glibc.malloc.hugetlb=1 LP_NUM_THREADS=4 "
              "/opt/gnomon-server --name left --listen 127.0.0.1:7431 --backend "
              "egl --gpu 1 --key /etc/a.key");
    EXPECT_EQ(commands[0].host, "127.0.0.1");
    EXPECT_EQ(commands[1].server, "far");
    EXPECT_EQ(commands[1].host, "wall01");
    EXPECT_EQ(commands[1].text(), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    All, EveryLaunch,
    testing::Values(Far{config::Launch::ssh,
                        "ssh -v -o BatchMode=yes -o ConnectTimeout=10 wall01 'exec '\\''/opt/my "
                        "wall/gnomon-server'\\'' --name far --listen 0.0.0.0:7430 --backend egl "
                        "--key /etc/a.key --exit-with-input'"},
                    Far{config::Launch::slurm,
                        "srun -v --nodelist=wall01 --nodes=1 --ntasks=1 --overlap --unbuffered "
                        "'/opt/my wall/gnomon-server' --name far --listen 0.0.0.0:7430 --backend "
                        "egl --key /etc/a.key --exit-with-input"},
                    Far{config::Launch::mpi,
                        "mpirun -v --host wall01 -n 1 '/opt/my wall/gnomon-server' --name far "
                        "--listen 0.0.0.0:7430 --backend egl --key /etc/a.key --exit-with-input"}),
    [](const auto& row) { return std::string{config::name(row.param.launch)}; });

TEST(LaunchCommands, ServersElsewhereFindTheUsualKeyThemselves) {
    auto config = threeServers(config::Launch::ssh);
    config.servers[1].host = "fe80::1";
    const auto commands = launchCommands(config, {.key = "/home/me/.config/gnomon/cluster.key"});
    EXPECT_NE(commands[0].text().find("--key"), std::string::npos);
    EXPECT_EQ(commands[1].text().find("--key"), std::string::npos);
    EXPECT_NE(commands[1].text().find("--listen :::7430"), std::string::npos);
}

TEST(LaunchCommands, ServersThatAreLookedUpAreNotStarted) {
    auto config = threeServers(config::Launch::ssh);
    config.cluster.lookup = "239.255.74.30:7430";
    config.servers[0] = {.name = "left", .host = ""};
    const auto commands = launchCommands(config, {});
    ASSERT_EQ(commands.size(), 2U);
    EXPECT_EQ(commands[0].server, "far");
}

TEST(LaunchCommands, ServersShareTheCores) {
    EXPECT_EQ(rasterizerThreads(1, 2), 2U);
    EXPECT_EQ(rasterizerThreads(2, 2), 0U);
    EXPECT_EQ(rasterizerThreads(2, 16), 8U);
    EXPECT_EQ(rasterizerThreads(3, 16), 5U);
    EXPECT_EQ(rasterizerThreads(48, 16), 0U);
}

}  // namespace
}  // namespace gnomon::client
