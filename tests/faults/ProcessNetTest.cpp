// Faults of processes: servers and clients that are killed, stopped, or started twice, and people
// and disks that do not take what is said.
#include <fcntl.h>
#include <sys/stat.h>

#include <array>

#include "FaultTest.h"

namespace gnomon::faults {
namespace {

class Process : public FaultTest {
protected:
    std::vector<std::string> run(const std::string& wall) const {
        return measured({"run", wall, "--backend", "none"});
    }
};

class ServerFault : public Process, public testing::WithParamInterface<Way> {};

TEST_P(ServerFault, CostsOneGapAndTheServerComesBack) {
    const auto wall = folder.write("wall.toml", text("timeout = 1.0"));
    Program run{this->run(wall)};
    ASSERT_TRUE(run.says("fps")) << run.output();
    const pid_t victim = processOf(right());
    ASSERT_EQ(::kill(victim, GetParam().signal), 0);
    ASSERT_TRUE(run.says("goes on without " + right())) << run.output();
    if (GetParam().signal == SIGSTOP) {
        ASSERT_TRUE(run.says("fps")) << run.output();
        ::kill(victim, SIGCONT);
    }
    ASSERT_TRUE(run.says(right() + " takes part")) << run.output();
    ASSERT_TRUE(run.says("fps")) << run.output();
    end(run);
    const auto trace = this->trace();
    expectOneGap(trace, 1000.0);
    // The line names the frame, and it is the frame in which it happened.
    const auto frame = trace.rows()[trace.dropOf(right())].frame;
    EXPECT_NE(run.output().find(fmt::format("frame {} goes on without {}\n", frame, right())),
              std::string::npos)
        << run.output();
    for (const auto& server : told()["servers"])
        EXPECT_EQ(server["lost"], server["name"] == right() ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(All, ServerFault,
                         testing::Values(Way{"killed", SIGKILL},
                                         Way{"stoppedAndContinued", SIGSTOP},
                                         Way{"endedAndRestarted", SIGTERM}),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Process, OnTimeoutWaitTheWallWaitsForAStoppedServer) {
    const auto wall = folder.write("wall.toml", text("timeout = 0.2\non_timeout = \"wait\""));
    Program run{this->run(wall)};
    ASSERT_TRUE(run.says("fps")) << run.output();
    const pid_t stopped = processOf(right());
    ASSERT_EQ(::kill(stopped, SIGSTOP), 0);
    last(1500ms);
    ::kill(stopped, SIGCONT);
    ASSERT_TRUE(run.says("fps")) << run.output();
    end(run);
    const auto trace = this->trace();
    EXPECT_EQ(trace.dropOf(right()), trace.rows().size());
    EXPECT_GT(trace.longest(1, trace.rows().size()), 1000.0) << "it did not wait";
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
}

// Who was away itself does not take the others for late.
TEST_F(Process, AStoppedClientLosesNobody) {
    const auto wall = folder.write("wall.toml", text("timeout = 0.5"));
    Program run{this->run(wall)};
    ASSERT_TRUE(run.says("fps")) << run.output();
    run.signal(SIGSTOP);
    last(1500ms);
    run.signal(SIGCONT);
    ASSERT_TRUE(run.says("fps")) << run.output();
    end(run);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
}

// 0.0.0.0 is this machine, and counts as another one, where servers are expected to be running.
class Standing : public Process {
protected:
    void SetUp() override {
        ports = {freePort(), freePort()};
        for (std::size_t i = 0; i < 2; ++i)
            servers.push_back(standingServer(names[i], "0.0.0.0", ports[i]));
        wall = standingWall("timeout = 1.0\nstart_timeout = 10.0", {"0.0.0.0", "0.0.0.0"}, ports);
    }
    void TearDown() override {
        servers.clear();
        Process::TearDown();
    }
    std::vector<int> ports;
    std::vector<std::unique_ptr<Program>> servers;
    std::string wall;
};

TEST_F(Standing, AClientThatIsKilledLeavesTheWallToTheNextOne) {
    Program first{{"run", wall}};
    ASSERT_TRUE(first.says("fps")) << first.output();
    first.signal(SIGKILL);
    EXPECT_EQ(first.wait(), 128 + SIGKILL);
    Program second{run(wall)};
    ASSERT_TRUE(second.says("fps")) << second.output();
    end(second);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(processOf(names[i]), servers[i]->pid()) << "another process";
        const auto said = servers[i]->errors();
        const auto left = std::count_if(said.begin(), said.end(), [](const std::string& line) {
            return line.find("client left: ") != std::string::npos;
        });
        EXPECT_EQ(left, 2) << testing::PrintToString(said);
    }
}

TEST_F(Standing, ASecondClientIsRefusedAndToldWhyAndTheFirstDoesNotNotice) {
    Program first{run(wall)};
    ASSERT_TRUE(first.says("fps")) << first.output();
    const auto impatient =
        standingWall("timeout = 1.0\nstart_timeout = 1.0", {"0.0.0.0", "0.0.0.0"}, ports);
    Program second{{"run", impatient}};
    EXPECT_EQ(second.wait(), 1);
    ASSERT_EQ(second.errors().size(), 1U);
    EXPECT_NE(second.errors()[0].find("serves another client (127.0.0.1:"), std::string::npos)
        << second.errors()[0];
    ASSERT_TRUE(first.says("fps")) << first.output();
    end(first);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
    const auto trace = this->trace();
    EXPECT_LT(trace.longest(1, trace.rows().size()), 1000.0 + slack);
}

/// A pipe that is full and that nobody reads.
class StuckPipe {
public:
    explicit StuckPipe(std::string path) : path_{std::move(path)} {
        ::mkfifo(path_.c_str(), 0600);
        fd_ = ::open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        const std::array<char, 4096> filler{};
        while (::write(fd_, filler.data(), filler.size()) > 0) {
        }
    }
    ~StuckPipe() { ::close(fd_); }
    StuckPipe(const StuckPipe&) = delete;
    StuckPipe& operator=(const StuckPipe&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
    int fd_ = -1;
};

TEST_F(Process, AFullDiskForLogsIsSaidOnceAndStallsNothing) {
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full here";
    auto words = this->run(file);
    for (const char* word : {"--log", "/dev/full"}) words.emplace_back(word);
    Program run{words};
    ASSERT_TRUE(
        run.says("warning: /dev/full: cannot be written: No space left on device; the run "
                 "goes on"))
        << run.output();
    // The launcher has something to say, and servers to start, as before.
    ASSERT_TRUE(run.says("fps")) << run.output();
    ASSERT_EQ(::kill(processOf(right()), SIGKILL), 0);
    ASSERT_TRUE(run.says(right() + " takes part")) << run.output();
    end(run);
    const auto said = run.output();
    EXPECT_EQ(said.find("No space"), said.rfind("No space")) << "said more than once";
}

TEST_F(Process, AFullDiskForTheTraceEndsTheTraceAlone) {
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full here";
    Program run{{"run", file, "--backend", "none", "--frames", "2000", "--trace", "/dev/full"}};
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    EXPECT_NE(run.output().find("/dev/full: cannot be written: No space left on device; the trace "
                                "ends"),
              std::string::npos)
        << run.output();
}

/// The shell puts standard output elsewhere.
std::vector<std::string> redirected(std::vector<std::string> words, const std::string& to) {
    std::string line = "exec \"$@\" > '" + to + "'";
    words.insert(words.begin(), {"-c", line, "sh", GNOMON_BIN_DIR "/gnomon"});
    return words;
}

TEST_F(Process, AFullDiskForStandardOutputIsSaidOnStandardError) {
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full here";
    Program run{redirected({"run", file, "--backend", "none", "--frames", "500"}, "/dev/full"),
                {},
                "/bin/sh"};
    EXPECT_EQ(run.wait(), 0);
    EXPECT_EQ(run.errors(),
              std::vector<std::string>{"gnomon: standard output cannot be written: No space left "
                                       "on device; the run goes on"});
}

TEST_F(Process, NobodyWaitsForWhoDoesNotReadWhatIsSaid) {
    const StuckPipe output{folder.path("output")};
    const StuckPipe log{folder.path("log")};
    Program run{redirected(measured({"run", file, "--backend", "none", "--frames", "2000", "--log",
                                     log.path()}),
                           output.path()),
                {},
                "/bin/sh"};
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    EXPECT_EQ(told()["frames"], 2000);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
}

}  // namespace
}  // namespace gnomon::faults
