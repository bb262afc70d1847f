// A wall of 2 x 2 whose servers are started by OpenSSH, Slurm and Open MPI, for real.
#include <gnomon/image/Png.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "Starters.h"
#include "WallTest.h"

namespace gnomon::wall {
namespace {

struct Row {
    const char* name = "";
    std::unique_ptr<Starter> (*make)() = nullptr;
};

class EveryStarter : public testing::TestWithParam<Row> {
protected:
    void SetUp() override {
        starter = GetParam().make();
        if (const auto why = starter->begin(folder)) GTEST_SKIP() << *why;
        Program keygen{{"keygen", "--out", folder.path("cluster.key")}};
        ASSERT_EQ(keygen.wait(), 0);
        for (const char* tile : {"a", "b", "c", "d"})
            names.push_back(fmt::format("{}-{}-{}", tile, ::getpid(), GetParam().name));
        file = folder.write("wall.toml", text(GNOMON_BIN_DIR "/gnomon-server"));
    }
    void TearDown() override { expectNothingLeft(); }

    std::string text(const std::string& server) const {
        std::string all = fmt::format(
            "name = \"test\"\n[user]\nhead = [0, 1, 2]\n[sync]\ntimeout = 2.0\n[[screen]]\n"
            "name = \"front\"\nlower_left = [-1, 0, 0]\nlower_right = [1, 0, 0]\n"
            "upper_left = [-1, 2, 0]\ntiles = [2, 2]\n[cluster]\nkey = \"cluster.key\"\n"
            "server = \"{}\"\n{}",
            server, starter->lines());
        for (std::size_t i = 0; i < names.size(); ++i)
            all += fmt::format(
                "[[server]]\nname = \"{}\"\nhost = \"{}\"\nport = {}\n[[server.window]]\n"
                "size = [80, 80]\n[[server.window.viewport]]\nscreen = \"front\"\n"
                "tile = [{}, {}]\n",
                names[i], starter->host(), freePort(), i % 2, i / 2);
        return all;
    }
    std::vector<std::string> words(std::vector<std::string> more) const {
        std::vector<std::string> all{"run", file};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    /// The server itself, not who starts it or keeps it company.
    pid_t serverOf(const std::string& name) const {
        for (const pid_t pid : serversNamed(name))
            if (programOf(pid) == "gnomon-server") return pid;
        return -1;
    }
    /// Neither servers nor starters; all of them carry a server's name.
    void expectNothingLeft() const {
        const auto deadline = std::chrono::steady_clock::now() + patience;
        for (const auto& name : names) {
            while (!processesWith(name).empty())
                if (std::chrono::steady_clock::now() > deadline) {
                    ADD_FAILURE() << name << ": " << processesWith(name).size() << " are left";
                    break;
                }
        }
    }

    Folder folder;
    std::unique_ptr<Starter> starter;  // before the folder goes
    std::vector<std::string> names;
    std::string file;
};

TEST_P(EveryStarter, BringsUpAWallThatDraws) {
    const auto out = folder.path("wall.png");
    Program run{words({"--backend", "osmesa", "--frames", "5", "--out", out}),
                starter->environment()};
    ASSERT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
    const auto picture = orThrow(image::readPng(out));
    EXPECT_EQ(picture.width, 160);
    EXPECT_EQ(picture.height, 160);
    EXPECT_EQ(run.output().find("is missing"), std::string::npos) << run.output();
}

TEST_P(EveryStarter, StartsAServerAgainThatIsKilled) {
    Program run{words({"--backend", "none"}), starter->environment()};
    ASSERT_TRUE(run.says("fps")) << testing::PrintToString(run.errors()) << run.output();
    const pid_t before = serverOf(names[2]);
    ASSERT_GT(before, 0);
    ASSERT_EQ(::kill(before, SIGKILL), 0);
    EXPECT_TRUE(run.says("goes on without " + names[2])) << run.output();
    EXPECT_TRUE(run.says(names[2] + " takes part")) << run.output();
    EXPECT_NE(run.output().find("; started again"), std::string::npos) << run.output();
    EXPECT_NE(serverOf(names[2]), before);
    EXPECT_TRUE(run.says("fps")) << run.output();
    run.signal(SIGINT);
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
}

/// A terminal sends it to everybody in the foreground, starters included.
TEST_P(EveryStarter, LeavesNothingAfterCtrlC) {
    Program run{words({"--backend", "none"}), starter->environment()};
    ASSERT_TRUE(run.says("fps")) << testing::PrintToString(run.errors()) << run.output();
    auto everybody = childrenOf(run.pid());
    EXPECT_EQ(everybody.size(), 4U);
    everybody.push_back(run.pid());
    for (const pid_t pid : everybody) ::kill(pid, SIGINT);
    EXPECT_EQ(run.wait(), 0) << run.output();
    EXPECT_TRUE(run.errors().empty()) << testing::PrintToString(run.errors());
    expectNothingLeft();
}

TEST_P(EveryStarter, LeavesNothingAfterItsEndByForce) {
    Program run{words({"--backend", "none"}), starter->environment()};
    ASSERT_TRUE(run.says("fps")) << testing::PrintToString(run.errors()) << run.output();
    run.signal(SIGKILL);
    EXPECT_EQ(run.wait(), 128 + SIGKILL);
    expectNothingLeft();
}

TEST_P(EveryStarter, SaysWhyNothingCanBeStarted) {
    file = folder.write("none.toml", text("/nonexistent/gnomon-server"));
    Program run{words({"--backend", "none"}), starter->environment()};
    EXPECT_EQ(run.wait(), 1) << run.output();
    ASSERT_EQ(run.errors().size(), 1U) << testing::PrintToString(run.errors());
    EXPECT_NE(run.errors()[0].find("server \""), std::string::npos) << run.errors()[0];
    EXPECT_NE(run.output().find("/nonexistent/gnomon-server"), std::string::npos) << run.output();
}

INSTANTIATE_TEST_SUITE_P(All, EveryStarter,
                         testing::Values(Row{"ssh", &sshStarter}, Row{"slurm", &slurmStarter},
                                         Row{"mpi", &mpiStarter}),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace gnomon::wall
