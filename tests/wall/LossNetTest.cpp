#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "WallTest.h"

namespace gnomon::wall {
namespace {

class Loss : public WallTest {
protected:
    static nlohmann::json read(const std::string& path) {
        std::ifstream in{path};
        return nlohmann::json::parse(in);
    }
};

TEST_F(Loss, AKilledServerIsGoneWithoutAndComesBack) {
    const auto json = folder.path("run.json");
    Program run{{"run", file, "--backend", "none", "--json", json}};
    ASSERT_TRUE(run.says("fps")) << run.output();
    ASSERT_EQ(::kill(processOf(names[0]), SIGKILL), 0);
    ASSERT_TRUE(run.says("goes on without " + names[0])) << run.output();
    ASSERT_TRUE(run.says(names[0] + " takes part")) << run.output();
    ASSERT_TRUE(run.says("fps")) << run.output();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0) << run.output();
    EXPECT_TRUE(run.errors().empty());

    const auto told = read(json);
    EXPECT_GT(told["frames"].get<int>(), 2);
    for (const auto& server : told["servers"]) {
        const int times = server["name"] == names[0] ? 1 : 0;
        EXPECT_EQ(server["lost"], times) << server;
        EXPECT_EQ(server["rejoined"], times) << server;
    }
    EXPECT_LT(told["frame_ms"]["median"].get<double>(), 100.0);
}

// The wall stands still for at most the timeout, then goes on at full rate.
TEST_F(Loss, AServerThatHangsIsLeftBehindAndComesBack) {
    const auto json = folder.path("run.json");
    Program run{{"run", file, "--backend", "none", "--json", json}};
    ASSERT_TRUE(run.says("fps")) << run.output();
    const pid_t hung = processOf(names[1]);
    ASSERT_EQ(::kill(hung, SIGSTOP), 0);
    ASSERT_TRUE(run.says("goes on without " + names[1])) << run.output();
    ASSERT_TRUE(run.says("fps")) << run.output();
    ASSERT_EQ(::kill(hung, SIGCONT), 0);
    ASSERT_TRUE(run.says(names[1] + " takes part")) << run.output();
    run.signal(SIGTERM);
    EXPECT_EQ(run.wait(), 0) << run.output();
    const auto told = read(json);
    // The timeout is 0.5 s; much more would be a wall that hangs.
    EXPECT_LT(told["frame_ms"]["max"].get<double>(), 5000.0);
}

TEST_F(Loss, WithoutAnyServerTheApplicationGoesOn) {
    Program run{{"run", file, "--backend", "none"}};
    ASSERT_TRUE(run.says("fps")) << run.output();
    for (const auto& name : names) ASSERT_EQ(::kill(processOf(name), SIGKILL), 0);
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(run.says("takes part")) << run.output();
    ASSERT_TRUE(run.says("fps")) << run.output();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0);
}

TEST_F(Loss, NothingIsLeftAfterAnInterrupt) {
    Program run{{"run", file, "--backend", "none"}};
    ASSERT_TRUE(run.says("fps")) << run.output();
    const auto begun = std::chrono::steady_clock::now();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, 5s);
    EXPECT_TRUE(serversNamed(names[0]).empty());
    EXPECT_TRUE(serversNamed(names[1]).empty());
    EXPECT_TRUE(run.errors().empty());
}

TEST_F(Loss, NothingIsLeftAfterTheLauncherIsKilled) {
    Program run{{"run", file, "--backend", "none"}};
    ASSERT_TRUE(run.says("fps")) << run.output();
    run.signal(SIGKILL);
    EXPECT_EQ(run.wait(), 128 + SIGKILL);
    EXPECT_TRUE(noneLeft(names));
}

TEST_F(Loss, AnInterruptWhileStartingEndsQuickly) {
    // Nobody answers at the address: reserved for documentation, RFC 5737.
    auto lines = text("timeout = 0.5", "host = \"192.0.2.1\"\nport = 7430");
    // Two servers on one host and port are refused: the second gets another one.
    lines.replace(lines.rfind("7430"), 4, "7431");
    const auto far = folder.write("far.toml", lines);
    Program keygen{{"keygen", "--out", folder.path("cluster.key")}};
    ASSERT_EQ(keygen.wait(), 0);
    Program run{{"run", far, "--backend", "none", "--key", folder.path("cluster.key")}};
    ASSERT_TRUE(run.says("waiting for " + names[0])) << run.output();
    const auto begun = std::chrono::steady_clock::now();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0) << run.output();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, 5s);
}

}  // namespace
}  // namespace gnomon::wall
