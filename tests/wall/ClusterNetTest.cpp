// A wall with a key, and one whose servers are started from elsewhere: a script takes ssh's place,
// and 0.0.0.0, which is this machine and counts as another one, the other machine's.
#include <sys/stat.h>

#include <csignal>

#include "WallTest.h"

namespace gnomon::wall {
namespace {

class Cluster : public WallTest {
protected:
    Cluster() {
        Program keygen{{"keygen", "--out", folder.path("cluster.key")}};
        EXPECT_EQ(keygen.wait(), 0) << testing::PrintToString(keygen.errors());
        // Its last word is the command; the server is its child, with its input.
        const auto ssh = folder.write("ssh", "#!/bin/sh\necho \"$@\" >> " + folder.path("words") +
                                                 "\nfor last; do :; done\nsh -c \"$last\"\n");
        ::chmod(ssh.c_str(), 0755);
    }
    /// Both servers on "another" machine.
    std::string farWall(const std::string& more = {}) {
        auto lines = text("timeout = 2.0", "host = \"0.0.0.0\"");
        ports.clear();
        for (const auto& name : names) {
            const auto at = lines.find(name) + name.size() + 2;
            ports.push_back(freePort());
            lines.insert(at, fmt::format("port = {}\n", ports.back()));
        }
        return folder.write("far.toml",
                            fmt::format("{}[cluster]\nkey = \"cluster.key\"\nserver = \"{}\"\n{}\n",
                                        lines, GNOMON_BIN_DIR "/gnomon-server", more));
    }
    std::vector<int> ports;
    std::string path() const { return "PATH=" + folder.path("") + ":" + std::getenv("PATH"); }
};

TEST_F(Cluster, LocalServersUseAKeyThatIsGiven) {
    Program run{
        {"run", file, "--backend", "none", "--frames", "50", "--key", folder.path("cluster.key")}};
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
}

TEST_F(Cluster, ServersAreStartedThroughSsh) {
    const auto wall = farWall("launch = \"ssh\"\noptions = [\"-p\", \"2222\"]");
    Program run{{"run", wall, "--backend", "none", "--frames", "50"}, {path()}};
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
    // What they say comes with their names before it.
    for (const auto& name : names)
        EXPECT_NE(run.output().find(name + ": no rendering"), std::string::npos) << run.output();
    EXPECT_TRUE(noneLeft(names));
}

TEST_F(Cluster, AServerThatDiesElsewhereIsStartedAgain) {
    const auto wall = farWall("launch = \"ssh\"");
    Program run{{"run", wall, "--backend", "none"}, {path()}};
    ASSERT_TRUE(run.says("fps"));
    const auto before = processOf(names[1]);
    ASSERT_GT(before, 0);
    ::kill(before, SIGKILL);
    EXPECT_TRUE(run.says("started again"));
    EXPECT_TRUE(run.says(names[1] + " takes part"));
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    EXPECT_TRUE(noneLeft(names));
}

TEST_F(Cluster, ServersElsewhereEndWithTheirClientHoweverThatEnds) {
    const auto wall = farWall("launch = \"ssh\"");
    Program run{{"run", wall, "--backend", "none"}, {path()}};
    ASSERT_TRUE(run.says("fps"));
    run.signal(SIGKILL);
    EXPECT_EQ(run.wait(), 128 + SIGKILL);
    EXPECT_TRUE(noneLeft(names));
}

TEST_F(Cluster, AMachineThatCannotBeReachedIsNamed) {
    folder.write("ssh", "#!/bin/sh\necho 'ssh: connect to host 0.0.0.0: refused' >&2\nexit 255\n");
    const auto wall = farWall("launch = \"ssh\"");
    Program run{{"run", wall, "--backend", "none"}, {path()}};
    EXPECT_EQ(run.wait(), 1);
    ASSERT_EQ(run.errors().size(), 1U);
    EXPECT_NE(run.errors()[0].find("exit code 255: ssh: connect to host"), std::string::npos)
        << run.errors()[0];
}

/// What ssh starts here has another key than what is said there.
TEST_F(Cluster, AStartedServerThatHasAnotherKeyEndsTheRunAtOnce) {
    Program keygen{{"keygen", "--out", folder.path("other.key")}};
    ASSERT_EQ(keygen.wait(), 0);
    const auto ssh = folder.write("ssh",
                                  "#!/bin/sh\nfor last; do :; done\n"
                                  "sh -c \"$(echo \"$last\" | sed s,/cluster.key,/other.key,)\"\n");
    ::chmod(ssh.c_str(), 0755);
    Program run{{"run", farWall("launch = \"ssh\""), "--backend", "none"}, {path()}};
    EXPECT_EQ(run.wait(), 1) << run.output();
    ASSERT_EQ(run.errors().size(), 1U) << run.output();
    EXPECT_NE(run.errors()[0].find("does not accept the cluster key"), std::string::npos)
        << run.errors()[0];
    EXPECT_NE(run.errors()[0].find("(0.0.0.0:"), std::string::npos) << run.errors()[0];
    EXPECT_TRUE(noneLeft(names));
}

TEST_F(Cluster, AServerThatRunsWithAnotherKeyIsNamedAndMayBePutRight) {
    Program keygen{{"keygen", "--out", folder.path("other.key")}};
    ASSERT_EQ(keygen.wait(), 0);
    const auto wall = farWall();
    const auto server = [&](std::size_t i, const std::string& key) {
        const auto address = "0.0.0.0:" + std::to_string(ports[i]);
        return std::make_unique<Program>(
            std::vector<std::string>{"--name", names[i], "--listen", address, "--backend", "none",
                                     "--key", folder.path(key)},
            std::vector<std::string>{}, "gnomon-server");
    };
    const auto left = server(0, "cluster.key");
    auto right = server(1, "other.key");
    ASSERT_TRUE(left->says("port") && right->says("port"));
    Program run{{"run", wall, "--backend", "none"}};
    ASSERT_TRUE(run.says("warning: " + names[1])) << run.output();
    EXPECT_NE(run.output().find("does not accept the cluster key"), std::string::npos);
    right->signal(SIGTERM);
    EXPECT_EQ(right->wait(), 0);
    right = server(1, "cluster.key");
    EXPECT_TRUE(run.says("fps")) << run.output();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    for (const auto* program : {left.get(), right.get()}) program->signal(SIGTERM);
}

TEST_F(Cluster, CheckSaysWhichServersAreThere) {
    const auto wall = farWall("launch = \"ssh\"");
    Program run{{"run", wall, "--backend", "none"}, {path()}};
    ASSERT_TRUE(run.says("fps"));
    Program there{{"check", wall, "--reach"}};
    EXPECT_EQ(there.wait(), 0) << there.output();
    for (const auto& name : names)
        EXPECT_NE(there.output().find(name + " (0.0.0.0:"), std::string::npos) << there.output();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0);
    Program gone{{"check", wall, "--reach"}};
    EXPECT_EQ(gone.wait(), 1);
    ASSERT_EQ(gone.errors().size(), 1U);
    EXPECT_NE(gone.errors()[0].find("2 of 2 servers"), std::string::npos) << gone.errors()[0];
}

TEST_F(Cluster, ADryRunSaysWhatWouldBeStarted) {
    const auto wall = farWall("launch = \"slurm\"");
    Program run{{"run", wall, "--backend", "egl", "--dry-run"}};
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    for (const auto& name : names)
        EXPECT_NE(run.output().find("--name " + name), std::string::npos) << run.output();
    EXPECT_NE(run.output().find("srun --nodelist=0.0.0.0"), std::string::npos);
    EXPECT_NE(run.output().find("--key " + folder.path("cluster.key")), std::string::npos);
}

}  // namespace
}  // namespace gnomon::wall
