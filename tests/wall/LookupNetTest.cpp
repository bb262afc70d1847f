// Walls whose servers run already, and are found by their names.
#include "../net/Announcers.h"
#include "WallTest.h"

namespace gnomon::wall {
namespace {

class Lookup : public WallTest {
protected:
    void SetUp() override {
        const auto why = net::test::whyNoMulticast();
        if (!why.empty()) GTEST_SKIP() << why;
    }
    /// Nobody's usual key is to be found.
    std::vector<std::string> environment() const {
        return {"XDG_CONFIG_HOME=" + folder.path("nobody")};
    }
    std::string wall(const std::string& sync = "timeout = 2.0") const {
        return folder.write("lookup.toml", text(sync) + "[cluster]\nlookup = \"" + group + "\"\n");
    }
    std::unique_ptr<Program> server(const std::string& name, int port = 0,
                                    const std::string& backend = "none") const {
        auto made = std::make_unique<Program>(
            std::vector<std::string>{"--name", name, "--listen", fmt::format("127.0.0.1:{}", port),
                                     "--backend", backend, "--announce", group},
            environment(), "gnomon-server");
        EXPECT_TRUE(made->says("port ")) << testing::PrintToString(made->errors());
        return made;
    }
    static std::string portOf(Program& server) { return server.output().substr(5, 5); }
    std::unique_ptr<Program> gnomon(std::vector<std::string> words) const {
        return std::make_unique<Program>(std::move(words), environment());
    }
    static void end(std::initializer_list<Program*> servers) {
        for (const auto* server : servers) server->signal(SIGTERM);
        for (auto* server : servers) EXPECT_EQ(server->wait(), 0);
    }
    const std::string group = net::test::lookupGroup();
};

TEST_F(Lookup, ServersAreFoundByTheirNamesAndShowTheWall) {
    const auto left = server(names[0], 0, "auto"), right = server(names[1], 0, "auto");
    const auto run = gnomon({"run", wall(), "--frames", "5", "--out", folder.path("wall.png")});
    EXPECT_EQ(run->wait(), 0) << testing::PrintToString(run->errors()) << run->output();
    for (const auto& [name, program] : {std::pair{names[0], left.get()}, {names[1], right.get()}}) {
        EXPECT_NE(run->output().find("waiting for an announcement of \"" + name + "\" on " + group +
                                     " (udp)"),
                  std::string::npos)
            << run->output();
        EXPECT_NE(
            run->output().find(fmt::format("{} (127.0.0.1:{}): found, ", name, portOf(*program))),
            std::string::npos)
            << run->output();
    }
    EXPECT_NE(run->output().find("wrote "), std::string::npos);
    // They wait for the next one.
    const auto again = gnomon({"run", wall(), "--frames", "5"});
    EXPECT_EQ(again->wait(), 0) << again->output();
    end({left.get(), right.get()});
}

TEST_F(Lookup, AServerThatReturnsOnAnotherPortIsFoundAgain) {
    const auto left = server(names[0]);
    const int one = freePort(), other = freePort();
    ASSERT_NE(one, other);
    auto right = server(names[1], one);
    const auto run = gnomon({"run", wall()});
    ASSERT_TRUE(run->says("fps")) << run->output();
    right->signal(SIGKILL);
    EXPECT_EQ(right->wait(), 128 + SIGKILL);
    ASSERT_TRUE(run->says("waiting for an announcement of \"" + names[1])) << run->output();
    ASSERT_TRUE(run->says("fps")) << run->output();
    right = server(names[1], other);
    ASSERT_TRUE(run->says(fmt::format("{} (127.0.0.1:{}): found", names[1], other)))
        << run->output();
    ASSERT_TRUE(run->says(names[1] + " takes part")) << run->output();
    run->signal(SIGINT);
    EXPECT_EQ(run->wait(), 0) << testing::PrintToString(run->errors());
    EXPECT_NE(run->output().find("goes on without " + names[1]), std::string::npos);
    end({left.get(), right.get()});
}

TEST_F(Lookup, TwoServersOfOneNameAreNamedTogether) {
    const auto left = server(names[0]), right = server(names[1]), second = server(names[1]);
    const auto run = gnomon({"run", wall()});
    ASSERT_TRUE(run->says("warning: " + names[1] + ": two servers have this name, at 127.0.0.1:"))
        << run->output();
    for (auto* program : {right.get(), second.get()})
        EXPECT_NE(run->output().find("127.0.0.1:" + portOf(*program)), std::string::npos)
            << run->output();
    ASSERT_TRUE(run->says("fps")) << run->output();
    run->signal(SIGINT);
    EXPECT_EQ(run->wait(), 0) << testing::PrintToString(run->errors());
    end({left.get(), right.get(), second.get()});
}

TEST_F(Lookup, NobodyIsWaitedForAndNamedAtTheEnd) {
    const auto left = server(names[0]);
    const auto run = gnomon({"run", wall("timeout = 0.5\nstart_timeout = 1.0")});
    EXPECT_EQ(run->wait(), 1) << run->output();
    const auto waiting =
        "waiting for an announcement of \"" + names[1] + "\" on " + group + " (udp)";
    EXPECT_NE(run->output().find(names[1] + ": " + waiting), std::string::npos) << run->output();
    ASSERT_EQ(run->errors().size(), 1U);
    EXPECT_NE(run->errors()[0].find("not all servers take part: " + names[1] +
                                    " (looked up): " + waiting),
              std::string::npos)
        << run->errors()[0];
    EXPECT_NE(run->errors()[0].find("there is no cluster key"), std::string::npos);
    EXPECT_EQ(run->errors()[0].find(names[0]), std::string::npos) << run->errors()[0];
    end({left.get()});
}

TEST_F(Lookup, CheckSaysWhereTheyAre) {
    const auto left = server(names[0]);
    const auto check = gnomon({"check", wall(), "--reach"});
    EXPECT_EQ(check->wait(), 1);
    EXPECT_NE(check->output().find(
                  fmt::format("{}: found at 127.0.0.1:{} after ", names[0], portOf(*left))),
              std::string::npos)
        << check->output();
    EXPECT_NE(
        check->output().find(fmt::format("{} (127.0.0.1:{}): is there", names[0], portOf(*left))),
        std::string::npos)
        << check->output();
    EXPECT_NE(check->output().find(names[1] + ": not found: nobody answered on " + group),
              std::string::npos)
        << check->output();
    ASSERT_EQ(check->errors().size(), 1U);
    EXPECT_NE(check->errors()[0].find("1 of 2 servers"), std::string::npos) << check->errors()[0];

    const auto right = server(names[1]), second = server(names[1]);
    const auto all = gnomon({"check", wall(), "--reach"});
    EXPECT_EQ(all->wait(), 0) << testing::PrintToString(all->errors());
    EXPECT_NE(all->output().find("warning: " + names[1] + ": 2 servers have this name"),
              std::string::npos)
        << all->output();
    const auto plain = gnomon({"check", wall()});
    EXPECT_EQ(plain->wait(), 0);
    EXPECT_NE(plain->output().find("servers are looked up on " + group), std::string::npos)
        << plain->output();
    end({left.get(), right.get(), second.get()});
}

TEST_F(Lookup, ADryRunSaysWhoIsLookedUp) {
    const auto run = gnomon({"run", wall(), "--dry-run"});
    EXPECT_EQ(run->wait(), 0) << testing::PrintToString(run->errors());
    for (const auto& name : names)
        EXPECT_NE(run->output().find("# " + name + ": expected to be running and looked up on " +
                                     group + " (udp)"),
                  std::string::npos)
            << run->output();
    EXPECT_EQ(run->output().find("gnomon-server"), std::string::npos) << run->output();
}

TEST_F(Lookup, LocalServersAreStartedAllTheSame) {
    const auto run = gnomon({"run", wall(), "--local", "--backend", "none", "--frames", "5"});
    EXPECT_EQ(run->wait(), 0) << testing::PrintToString(run->errors()) << run->output();
}

TEST_F(Lookup, AGroupThatIsNoneIsWrongUsage) {
    Program wrong{{"--name", names[0], "--announce", "10.0.0.1:7430"}, {}, "gnomon-server"};
    EXPECT_EQ(wrong.wait(), 2);
    EXPECT_NE(testing::PrintToString(wrong.errors()).find("multicast group"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::wall
