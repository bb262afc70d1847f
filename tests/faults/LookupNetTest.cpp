// Servers on other machines, found by name. Client and servers live in network namespaces.
#include "FaultTest.h"
#include "Namespaces.h"

namespace gnomon::faults {
namespace {

class FarLookup : public FaultTest {
protected:
    void SetUp() override {
        const auto why = whyNoNamespaces();
        if (!why.empty()) GTEST_SKIP() << why;
        client = std::make_unique<Namespace>();
        far = std::make_unique<Namespace>();
        const Inside inside{*client};
        command({"ip", "link", "add", "wire0", "type", "veth", "peer", "name", "wire1", "netns",
                 far->path()});
        connect("10.99.1.1/24", "wire0");
        const Inside there{*far};
        connect("10.99.1.2/24", "wire1");
    }
    void TearDown() override {
        servers.clear();
        FaultTest::TearDown();
    }
    static void connect(const std::string& address, const std::string& device) {
        command({"ip", "address", "add", address, "dev", device});
        command({"ip", "link", "set", device, "up"});
    }
    std::unique_ptr<Program> server(const std::string& name, const std::string& address,
                                    const std::string& keyFile) {
        auto made = std::make_unique<Program>(
            std::vector<std::string>{"--name", name, "--listen", address + ":0", "--backend",
                                     "none", "--key", keyFile, "--announce"},
            std::vector<std::string>{}, "gnomon-server");
        EXPECT_TRUE(made->says("port ")) << testing::PrintToString(made->errors());
        return made;
    }
    std::unique_ptr<Program> farServer(const std::string& name, const std::string& address,
                                       const std::string& keyFile) {
        const Inside there{*far};
        return server(name, address, keyFile);
    }
    std::unique_ptr<Program> run(std::vector<std::string> words,
                                 std::vector<std::string> environment = {}) const {
        const Inside here{*client};
        return std::make_unique<Program>(std::move(words), std::move(environment));
    }
    std::string wall(const std::string& more = {},
                     const std::string& sync = "timeout = 2.0") const {
        return folder.write("lookup.toml",
                            text(sync) + "[cluster]\nlookup = \"239.255.74.30:7430\"\n" + more);
    }
    std::unique_ptr<Namespace> client, far;
    std::vector<std::unique_ptr<Program>> servers;
};

TEST_F(FarLookup, ServersWithTheKeyAreFoundOnOtherMachines) {
    servers.push_back(farServer(left(), "0.0.0.0", key()));
    servers.push_back(farServer(right(), "10.99.1.2", key()));
    const auto wall = this->wall("key = \"cluster.key\"\n");
    const auto check = run({"check", wall, "--reach"});
    EXPECT_EQ(check->wait(), 0) << check->output();
    for (const auto& name : names)
        EXPECT_NE(check->output().find(name + ": found at 10.99.1.2:"), std::string::npos)
            << check->output();
    const auto shown = run({"run", wall, "--frames", "50"});
    EXPECT_EQ(shown->wait(), 0) << testing::PrintToString(shown->errors()) << shown->output();
}

/// A server for its own machine only does not answer others; one that has the name as well, but not
/// the key, costs a handshake.
TEST_F(FarLookup, LoopbackAnswersNobodyElseAndAnotherKeyIsPassedOver) {
    const auto other = folder.path("other.key");
    Program keygen{{"keygen", "--out", other}};
    ASSERT_EQ(keygen.wait(), 0);
    servers.push_back(farServer(left(), "0.0.0.0", key()));
    servers.push_back(farServer(right(), "127.0.0.1", key()));
    servers.push_back(farServer(right(), "0.0.0.0", other));
    const auto shown = run({"run", wall("key = \"cluster.key\"\n")});
    ASSERT_TRUE(shown->says("does not accept the cluster key")) << shown->output();
    EXPECT_EQ(shown->output().find("two servers"), std::string::npos) << shown->output();
    servers.push_back(farServer(right(), "0.0.0.0", key()));
    ASSERT_TRUE(shown->says("fps")) << shown->output();
    end(*shown);
}

TEST_F(FarLookup, WithoutAKeyOnlyThisMachineIsAsked) {
    servers.push_back(farServer(left(), "0.0.0.0", key()));
    servers.push_back(farServer(right(), "0.0.0.0", key()));
    const auto nobody = run({"run", wall({}, "timeout = 0.5\nstart_timeout = 1.0")},
                            {"XDG_CONFIG_HOME=" + folder.path("nobody")});
    EXPECT_EQ(nobody->wait(), 1) << nobody->output();
    ASSERT_EQ(nobody->errors().size(), 1U);
    EXPECT_NE(nobody->errors()[0].find("from this machine only: there is no cluster key"),
              std::string::npos)
        << nobody->errors()[0];
}

/// Its address is not known before its network is: it is found when that comes up.
TEST_F(FarLookup, AServerIsFoundAcrossANetworkThatComesLater) {
    {
        const Inside there{*far};
        command({"ip", "link", "set", "wire1", "down"});
    }
    servers.push_back(farServer(left(), "0.0.0.0", key()));
    servers.push_back(farServer(right(), "0.0.0.0", key()));
    const auto shown = run({"run", wall("key = \"cluster.key\"\n")});
    ASSERT_TRUE(shown->says("waiting for an announcement")) << shown->output();
    {
        const Inside there{*far};
        command({"ip", "link", "set", "wire1", "up"});
    }
    ASSERT_TRUE(shown->says("fps")) << shown->output();
    end(*shown);
}

}  // namespace
}  // namespace gnomon::faults
