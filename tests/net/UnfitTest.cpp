// Whether to try again is of use.
#include <gnomon/net/Codec.h>
#include <gtest/gtest.h>

#include <thread>

#include "RawSocket.h"
#include "TestServer.h"

namespace gnomon::net::test {
namespace {

/// The one server's status once the hub has logged that.
ServerStatus statusAfter(TestHub& hub, const std::string& said) {
    const auto limit = eventually();
    while (!hub.logContains(said) && SteadyClock::now() < limit)
        EXPECT_FALSE(hub->waitForAll({}, in(20ms)));
    EXPECT_TRUE(hub.logContains(said)) << testing::PrintToString(hub.log());
    return hub->status().at(0);
}

TEST(Unfit, IsAServerWithAnotherKey) {
    TestServer server{"left", {.key = testKey('1')}};
    TestHub hub{{}, {}, testKey('2')};
    hub->connect(server.address());
    EXPECT_TRUE(statusAfter(hub, "does not accept the cluster key").unfit);
}

TEST(Unfit, IsAServerThatWantsAKeyWhereThereIsNone) {
    TestServer server{"left", {.key = testKey()}};
    TestHub hub;
    hub->connect(server.address());
    EXPECT_TRUE(statusAfter(hub, "a cluster key is needed").unfit);
}

/// Like the client's, but not the same.
class OtherDerived final : public field::Container<OtherDerived> {
public:
    static constexpr std::string_view typeName = "Derived";
    field::Field<std::string> frame;
    static constexpr auto fields() {
        return std::tuple{field::entry("frame", &OtherDerived::frame)};
    }
};

TEST(Unfit, IsAServerWithAnotherTypeOfTheSameName) {
    TestServer server{"left",
                      {.types = [](field::TypeRegistry& types) { types.add<OtherDerived>(); }}};
    TestHub hub;
    hub->connect(server.address());
    EXPECT_TRUE(statusAfter(hub, "refused: ").unfit);
}

/// A hub whose server, all by itself, answers with these bytes.
ServerStatus statusAfterAnswer(std::span<const std::byte> answer, const std::string& said) {
    DeafListener listener;
    TestHub hub;
    hub->connect({.name = "left", .host = "127.0.0.1", .port = listener.port()});
    auto socket = listener.accept();
    socket.read(8);
    socket.send(answer);
    return statusAfter(hub, said);
}

TEST(Unfit, IsAServerOfAnotherVersion) {
    EXPECT_TRUE(statusAfterAnswer(packet(wire::ServerHello{.version = 9, .server = "left"}),
                                  "protocol version 9, expected 1")
                    .unfit);
    EXPECT_TRUE(
        statusAfterAnswer(packet(wire::Refused{.why = "version", .cure = wire::Cure::restart}),
                          "refused: version")
            .unfit);
}

TEST(Unfit, IsNoServerThatServesSomebodyElse) {
    TestServer server{"left"};
    TestHub first, second;
    first->connect(server.address());
    ASSERT_TRUE(first->waitForAll({}, eventually()));
    second->connect(server.address());
    EXPECT_FALSE(statusAfter(second, "serves another client").unfit);
}

TEST(Unfit, IsNoServerThatIsNotThereOrDies) {
    std::uint16_t port = 0;
    {
        const DeafListener gone;
        port = gone.port();
    }
    TestHub hub;
    hub->connect({.name = "left", .host = "127.0.0.1", .port = port});
    EXPECT_FALSE(statusAfter(hub, "refused").unfit);

    // One that dies in the middle of the TLS handshake looks like one without a key.
    DeafListener listener;
    TestHub sealed{{}, {}, testKey()};
    sealed->connect({.name = "left", .host = "127.0.0.1", .port = listener.port()});
    {
        auto socket = listener.accept();
        socket.read(100);
    }
    EXPECT_FALSE(statusAfter(sealed, "within the TLS handshake").unfit);
}

TEST(Unfit, PassesWhenTheServerIsPutRight) {
    std::uint16_t port = 0;
    TestHub hub{{}, {}, testKey('1')};
    {
        TestServer wrong{"left", {.key = testKey('2')}};
        port = wrong.address().port;
        hub->connect(wrong.address());
        EXPECT_TRUE(statusAfter(hub, "does not accept the cluster key").unfit);
    }
    TestServer right{"left", {.port = port, .key = testKey('1')}};
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
    EXPECT_FALSE(hub->status().at(0).unfit);
}

}  // namespace
}  // namespace gnomon::net::test
