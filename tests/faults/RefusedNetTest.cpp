// Who does not fit is refused with a sentence, and whoever is served does not notice.
#include <gnomon/net/ClientHub.h>
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/Codec.h>
#include <gnomon/net/ServerMessages.h>
#include <gnomon/scene/Types.h>

#include <mutex>

#include "../net/RawSocket.h"
#include "FaultTest.h"

namespace gnomon::faults {
namespace {

using net::test::DeafListener;
using net::test::RawSocket;

/// A hub and what it says.
class Hub {
public:
    explicit Hub(field::TypeRegistry types) : types_{std::move(types)} {
        net::HubHooks hooks;
        hooks.log = [this](net::LogLevel, const std::string& line) {
            const std::lock_guard lock{mutex_};
            lines_ += line + "\n";
        };
        hub_ = std::make_unique<net::ClientHub>(types_, net::SyncOptions{}, hooks);
    }
    ~Hub() { hub_.reset(); }
    Hub(const Hub&) = delete;
    Hub& operator=(const Hub&) = delete;
    net::ClientHub* operator->() { return hub_.get(); }
    /// Waits for such a line.
    bool says(const std::string& part) {
        const auto limit = std::chrono::steady_clock::now() + wall::patience;
        while (std::chrono::steady_clock::now() < limit) {
            if (hub_->waitForAll({}, std::chrono::steady_clock::now() + 20ms)) return false;
            const std::lock_guard lock{mutex_};
            if (lines_.find(part) != std::string::npos) return true;
        }
        return false;
    }
    std::string lines() {
        const std::lock_guard lock{mutex_};
        return lines_;
    }

private:
    field::TypeRegistry types_;
    std::mutex mutex_;
    std::string lines_;
    std::unique_ptr<net::ClientHub> hub_;
};

class Refused : public FaultTest {
protected:
    /// A server for this machine only, without a key. Its port.
    std::uint16_t serve() {
        server = std::make_unique<Program>(
            std::vector<std::string>{"--name", right(), "--backend", "none"},
            std::vector<std::string>{}, "gnomon-server");
        EXPECT_TRUE(server->says("port "));
        return static_cast<std::uint16_t>(std::stoi(server->output().substr(5)));
    }
    void TearDown() override {
        server.reset();
        FaultTest::TearDown();
    }
    net::ServerAddress address(std::uint16_t port) const {
        return {.name = right(), .host = "127.0.0.1", .port = port};
    }
    static field::TypeRegistry sceneTypes() {
        field::TypeRegistry types;
        scene::addTypes(types);
        return types;
    }
    std::unique_ptr<Program> server;
};

TEST_F(Refused, AWrongKeyIsNamedOnBothSidesAndTheWallDoesNotNotice) {
    const std::vector<int> ports{freePort(), freePort()};
    std::vector<std::unique_ptr<Program>> servers;
    for (std::size_t i = 0; i < 2; ++i)
        servers.push_back(standingServer(names[i], "0.0.0.0", ports[i]));
    const auto wall =
        standingWall("timeout = 1.0\nstart_timeout = 1.0", {"0.0.0.0", "0.0.0.0"}, ports);
    Program run{measured({"run", wall})};
    ASSERT_TRUE(run.says("fps")) << run.output();
    const auto other = folder.path("other.key");
    Program keygen{{"keygen", "--out", other}};
    ASSERT_EQ(keygen.wait(), 0);
    Program stranger{{"run", wall, "--key", other}};
    EXPECT_EQ(stranger.wait(), 1);
    ASSERT_EQ(stranger.errors().size(), 1U);
    EXPECT_NE(stranger.errors()[0].find("does not accept the cluster key"), std::string::npos)
        << stranger.errors()[0];
    const auto said = testing::PrintToString(servers[1]->errors());
    EXPECT_NE(said.find("it has another cluster key"), std::string::npos) << said;
    ASSERT_TRUE(run.says("fps")) << run.output();
    end(run);
    for (const auto& entry : told()["servers"]) EXPECT_EQ(entry["lost"], 0);
}

TEST_F(Refused, AClientOfAnotherVersionIsToldBothNumbers) {
    const auto port = serve();
    RawSocket raw{port};
    raw.send(net::packet(net::wire::ClientHello{.version = 77}));
    bool closed = false;
    const auto reply = raw.readAll(&closed);
    EXPECT_TRUE(closed);
    ASSERT_GT(reply.size(), 8U);
    const auto refused = net::decode<net::wire::Refused>(std::span{reply}.subspan(8));
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->why.find("protocol version 77, expected "), std::string::npos)
        << refused->why;
    Hub hub{sceneTypes()};
    hub->connect(address(port));
    EXPECT_TRUE(hub->waitForAll({}, std::chrono::steady_clock::now() + wall::patience));
}

TEST_F(Refused, AServerOfAnotherVersionIsNamedWithBothNumbers) {
    DeafListener listener;
    Hub hub{sceneTypes()};
    hub->connect(address(listener.port()));
    auto connection = listener.accept();
    connection.send(net::packet(net::wire::ServerHello{.version = 77, .server = right()}));
    EXPECT_TRUE(hub.says("protocol version 77, expected ")) << hub.lines();
    EXPECT_NE(hub.lines().find(right() + " (127.0.0.1:"), std::string::npos) << hub.lines();
}

/// Like a type of the scene's, and not the same.
class OtherTransform final : public field::Container<OtherTransform> {
public:
    static constexpr std::string_view typeName = "Transform";
    field::Field<std::uint32_t> matrix;
    static constexpr auto fields() {
        return std::tuple{field::entry("matrix", &OtherTransform::matrix)};
    }
};

TEST_F(Refused, AnotherSchemaIsRefusedByTypeAndField) {
    const auto port = serve();
    field::TypeRegistry types;
    types.add<OtherTransform>();
    {
        Hub hub{std::move(types)};
        hub->connect(address(port));
        EXPECT_TRUE(hub.says("\"Transform\"")) << hub.lines();
        EXPECT_NE(hub.lines().find("refused: "), std::string::npos) << hub.lines();
    }
    Hub hub{sceneTypes()};
    hub->connect(address(port));
    EXPECT_TRUE(hub->waitForAll({}, std::chrono::steady_clock::now() + wall::patience));
}

}  // namespace
}  // namespace gnomon::faults
