#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "WallTest.h"

namespace gnomon::wall {
namespace {

class Refusal : public WallTest {
protected:
    /// Exit code 1 or 2, exactly one line on standard error, and that says this.
    void expectEnd(Program& run, int code, const std::vector<std::string>& parts) {
        EXPECT_EQ(run.wait(), code) << run.output();
        const auto errors = run.errors();
        ASSERT_EQ(errors.size(), 1U) << testing::PrintToString(errors);
        for (const auto& part : parts)
            EXPECT_NE(errors[0].find(part), std::string::npos) << errors[0];
    }
    /// The second server where nobody is, by RFC 5737.
    std::string farWall() const {
        auto lines = text("timeout = 0.2\nstart_timeout = 1.0", "host = \"127.0.0.1\"");
        return lines.replace(lines.rfind("127.0.0.1"), 9, "192.0.2.1");
    }
};

TEST_F(Refusal, OfAMissingScene) {
    Program run{{"run", file, "--backend", "none", "--scene", folder.path("none.glb")}};
    expectEnd(run, 1, {"none.glb"});
}

TEST_F(Refusal, OfASceneThatIsNone) {
    Program run{{"run", file, "--backend", "none", "--scene",
                 folder.write("bad.glb", "glTF, but not really")}};
    expectEnd(run, 1, {"bad.glb"});
}

TEST_F(Refusal, OfAMissingConfig) {
    Program run{{"run", folder.path("none.toml"), "--backend", "none"}};
    expectEnd(run, 1, {"none.toml"});
}

TEST_F(Refusal, OfABrokenConfig) {
    auto broken = text();
    broken.replace(broken.find("head"), 4, "hand");
    Program run{{"run", folder.write("broken.toml", broken), "--backend", "none"}};
    expectEnd(run, 1, {"broken.toml:3:", "hand", "head"});
}

TEST_F(Refusal, OfABrokenCameraPath) {
    Program run{
        {"run", file, "--backend", "none", "--path", folder.write("way.jsonl", "{\"time\": 0}\n")}};
    expectEnd(run, 1, {"way.jsonl:1:", "\"eye\""});
}

TEST_F(Refusal, OfATakenPort) {
    const int taken = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    ASSERT_EQ(::bind(taken, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(taken, 1), 0);
    ASSERT_EQ(::getsockname(taken, reinterpret_cast<sockaddr*>(&address), &length), 0);
    const int port = ntohs(address.sin_port);
    auto lines = text();
    const auto at = lines.find(names[1]) + names[1].size() + 2;
    lines.insert(at, fmt::format("port = {}\n", port));
    Program run{{"run", folder.write("taken.toml", lines), "--backend", "none"}};
    expectEnd(run, 1, {names[1], std::to_string(port), "in use"});
    ::close(taken);
}

TEST_F(Refusal, OfServersThatCannotStart) {
    Program run{{"run", file, "--backend", "glfw"}, {"DISPLAY=", "WAYLAND_DISPLAY="}};
    expectEnd(run, 1, {"server \"", "exit code 1", "DISPLAY"});
}

TEST_F(Refusal, OfServersThatDoNotAnswer) {
    Program keygen{{"keygen", "--out", folder.path("cluster.key")}};
    ASSERT_EQ(keygen.wait(), 0);
    Program run{{"run", folder.write("far.toml", farWall()), "--backend", "none", "--key",
                 folder.path("cluster.key")}};
    expectEnd(run, 1, {names[1], "192.0.2.1:7430"});
}

TEST_F(Refusal, OfOtherComputersWithoutAKey) {
    const auto home = "XDG_CONFIG_HOME=" + folder.path("nobody");
    Program run{{"run", folder.write("far.toml", farWall()), "--backend", "none"}, {home}};
    expectEnd(run, 1, {"far.toml:", names[1], "192.0.2.1", "cluster key", "gnomon keygen"});
    Program missing{{"run", file, "--backend", "none", "--key", folder.path("none.key")}};
    expectEnd(missing, 1, {"none.key: cannot read the cluster key"});
    Program server{{"--name", names[0], "--listen", "0.0.0.0:0", "--backend", "none"},
                   {home},
                   "gnomon-server"};
    expectEnd(server, 1, {"cannot listen on 0.0.0.0", "cluster key", "gnomon keygen"});
}

TEST_F(Refusal, OfAKeyThatOthersMayRead) {
    const auto key = folder.path("cluster.key");
    Program keygen{{"keygen", "--out", key}};
    ASSERT_EQ(keygen.wait(), 0);
    Program again{{"keygen", "--out", key}};
    expectEnd(again, 1, {"cluster.key: is there already"});
    ASSERT_EQ(::chmod(key.c_str(), 0644), 0);
    Program run{{"run", file, "--backend", "none", "--key", key}};
    expectEnd(run, 1, {"cluster.key: others may read", "chmod 600"});
    Program server{{"--name", names[0], "--backend", "none", "--key", key}, {}, "gnomon-server"};
    expectEnd(server, 1, {"cluster.key: others may read", "chmod 600"});
}

TEST_F(Refusal, OfWrongUsage) {
    const std::vector<std::vector<std::string>> wrong{{"run"},
                                                      {"dance"},
                                                      {"run", file, "--eye", "1,2"},
                                                      {"run", file, "--frames", "0"},
                                                      {"run", file, "--backend", "vulkan"},
                                                      {"run", file, "--tile", "480"},
                                                      {"run", file, "--technique", "sdt"},
                                                      {"check"},
                                                      {}};
    for (const auto& words : wrong) {
        Program run{words};
        expectEnd(run, 2, {});
    }
}

TEST_F(Refusal, IsNotForHelp) {
    Program run{{"run", "--help"}};
    EXPECT_EQ(run.wait(), 0);
    EXPECT_NE(run.output().find("--map-size"), std::string::npos);
    EXPECT_TRUE(run.errors().empty());
}

}  // namespace
}  // namespace gnomon::wall
