// Who is let in, who is not, and what is said to them.
#include <gnomon/net/Codec.h>
#include <gtest/gtest.h>

#include <cstring>

#include "RawSocket.h"
#include "TestServer.h"

namespace gnomon::net::test {
namespace {

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span{text}); }

/// The sentence of a Refused message.
std::string refusal(std::span<const std::byte> reply) {
    if (reply.size() < 8) return "(no reply)";
    std::uint32_t type = 0;
    std::memcpy(&type, reply.data() + 4, 4);
    if (type != static_cast<std::uint32_t>(MessageType::refused)) return "(not a refusal)";
    const auto refused = decode<wire::Refused>(reply.subspan(8));
    return refused ? refused->why : refused.error().what;
}

/// The body of the first message of that type; empty where the connection ends before.
std::vector<std::byte> awaitMessage(RawSocket& raw, MessageType wanted) {
    std::vector<std::byte> input;
    while (true) {
        std::uint32_t length = 0, type = 0;
        if (input.size() >= 8) {
            std::memcpy(&length, input.data(), 4);
            std::memcpy(&type, input.data() + 4, 4);
        }
        if (input.size() < 8 || input.size() < 8 + std::size_t{length}) {
            const auto more = raw.read(1);
            if (more.empty()) return {};
            input.insert(input.end(), more.begin(), more.end());
            continue;
        }
        const auto end = input.begin() + 8 + static_cast<std::ptrdiff_t>(length);
        if (type == static_cast<std::uint32_t>(wanted)) return {input.begin() + 8, end};
        input.erase(input.begin(), end);
    }
}

void expectStillServing(TestServer& server) {
    TestHub hub;
    hub->connect(server.address());
    const auto joined = hub->waitForAll({}, eventually());
    EXPECT_TRUE(joined) << joined.error().what;
}

TEST(Handshake, ASecondClientIsRefusedWithASentence) {
    TestServer server{"left"};
    TestHub first, second;
    first->connect(server.address());
    ASSERT_TRUE(first->waitForAll({}, eventually()));
    second->connect(server.address());
    std::string text;
    const auto limit = eventually();
    while (text.find("refused") == std::string::npos && SteadyClock::now() < limit) {
        const auto waited = second->waitForAll({}, in(50ms));
        ASSERT_FALSE(waited);
        text = waited.error().what;
    }
    EXPECT_NE(text.find("left (127.0.0.1:"), std::string::npos) << text;
    EXPECT_NE(text.find("refused: server \"left\" serves another client (127.0.0.1:"),
              std::string::npos)
        << text;
    EXPECT_TRUE(first->frame({}, 0).droppedNow.empty());
    // When the first one leaves, the second gets in by itself.
    first->shutdown();
    EXPECT_TRUE(second->waitForAll({}, eventually()));
}

class OtherThing final : public field::Container<OtherThing> {
public:
    static constexpr std::string_view typeName = "Thing";  // like the client's, but not the same
    field::Field<Placement> place;
    field::Field<std::uint32_t> data;
    static constexpr auto fields() {
        return std::tuple{field::entry("place", &OtherThing::place),
                          field::entry("data", &OtherThing::data)};
    }
};

TEST(Handshake, TypesThatDisagreeAreRefusedByTypeAndField) {
    TestServer server{"left",
                      {.types = [](field::TypeRegistry& types) { types.add<OtherThing>(); }}};
    TestHub hub;
    hub->connect(server.address());
    std::string text;
    const auto limit = eventually();
    while (text.find("refused") == std::string::npos && SteadyClock::now() < limit)
        text = hub->waitForAll({}, in(50ms)).error().what;
    EXPECT_NE(text.find("\"Thing\""), std::string::npos) << text;
    EXPECT_NE(text.find("\"data\""), std::string::npos) << text;
    EXPECT_EQ(server.seen().joined, 0);
}

TEST(Handshake, AServerThatDoesNotKnowATypeKeepsItsContainersAnyway) {
    TestServer server{"left", {.types = [](field::TypeRegistry& types) { types.add<Derived>(); }}};
    TestHub hub;
    Editor editor{hub.types()};
    hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 0; n < 20; ++n) hub->frame(editor.edits(5), 0);
    ASSERT_TRUE(
        server.waitUntil([](const Seen& s) { return !s.frames.empty() && s.frames.back() == 20; }));
    EXPECT_EQ(server.seen().error, "");
    EXPECT_EQ(server.seen().digests.at(20), editor.aspect().digest());
}

struct Garbage {
    const char* name = "";
    std::vector<std::byte> bytes = {};
    const char* expected = "";  // in the refusal; "": the connection just ends
};

class EveryGarbage : public testing::TestWithParam<Garbage> {};

TEST_P(EveryGarbage, EndsItsConnectionAndNothingElse) {
    TestServer server{"left"};
    RawSocket raw{server.port()};
    raw.send(GetParam().bytes);
    bool closed = false;
    const auto reply = raw.readAll(&closed);
    EXPECT_TRUE(closed);
    if (*GetParam().expected != '\0') {
        EXPECT_NE(refusal(reply).find(GetParam().expected), std::string::npos) << refusal(reply);
    }
    expectStillServing(server);
}

std::vector<std::byte> copy(std::span<const std::byte> bytes) {
    return {bytes.begin(), bytes.end()};
}

std::vector<Garbage> garbage() {
    auto longHello = packet(wire::ClientHello{});
    const std::uint32_t twoGigabytes = 0x7fffffff;
    std::memcpy(longHello.data(), &twoGigabytes, 4);
    return {
        {.name = "http", .bytes = copy(bytesOf("GET / HTTP/1.1\r\nHost: wall\r\n\r\n"))},
        {.name = "zeros", .bytes = std::vector<std::byte>(100)},
        {.name = "announcedTwoGigabytes", .bytes = longHello},
        {.name = "wrongMagic",
         .bytes = packet(wire::ClientHello{.magic = 0x12345678}),
         .expected = "0x12345678"},
        {.name = "wrongVersion",
         .bytes = packet(wire::ClientHello{.version = 77}),
         .expected = "protocol version 77, expected 1"},
        {.name = "swapBeforeHello", .bytes = packet(wire::Swap{.n = 1})},
        {.name = "bulkWithoutSession",
         .bytes = packet(wire::ClientHello{.role = wire::Role::bulk, .token = 5}),
         .expected = "belongs to no session"},
        {.name = "malformedSchema",
         .bytes = packet(wire::ClientHello{.schema = std::vector<std::byte>(3)}),
         .expected = "malformed"},
    };
}

INSTANTIATE_TEST_SUITE_P(All, EveryGarbage, testing::ValuesIn(garbage()),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Handshake, GarbageAfterTheHelloEndsTheSession) {
    TestServer server{"left"};
    RawSocket raw{server.port()};
    raw.send(packet(wire::ClientHello{.token = 9, .schema = testTypes().schema()}));
    EXPECT_GE(raw.read(8).size(), 8U);
    ASSERT_TRUE(server.waitUntil([](const Seen& s) { return s.joined == 1; }));
    raw.send(std::vector<std::byte>(64, std::byte{0xee}));
    bool closed = false;
    raw.readAll(&closed);
    EXPECT_TRUE(closed);
    ASSERT_TRUE(server.waitUntil([](const Seen& s) { return s.left.size() == 1; }));
    EXPECT_NE(server.seen().left[0].find("not expected here"), std::string::npos)
        << server.seen().left[0];
    expectStillServing(server);
}

TEST(Handshake, ARelayThatCannotBeReachedIsToldOf) {
    TestServer server{"left"};
    RawSocket raw{server.port()};
    raw.send(packet(wire::ClientHello{.token = 9, .schema = testTypes().schema()}));
    raw.send(packet(wire::Relay{.token = 5, .host = "127.0.0.1", .port = 1}));
    const auto lost = decode<wire::RelayLost>(awaitMessage(raw, MessageType::relayLost));
    ASSERT_TRUE(lost) << lost.error().what;
    EXPECT_EQ(lost->token, 5U);
    EXPECT_NE(lost->why.find("refused"), std::string::npos) << lost->why;
}

TEST(Handshake, AClientThatSaysNothingIsPutOutAfterAWhile) {
    TestServer server{"left", {.handshakeTimeout = 150ms}};
    RawSocket raw{server.port()};
    bool closed = false;
    const auto reply = raw.readAll(&closed);
    EXPECT_TRUE(closed);
    EXPECT_NE(refusal(reply).find("no Hello within 150 ms"), std::string::npos);
    expectStillServing(server);
}

TEST(Handshake, AClientWithoutABulkConnectionIsPutOutAfterAWhile) {
    TestServer server{"left", {.handshakeTimeout = 150ms}};
    RawSocket raw{server.port()};
    raw.send(packet(wire::ClientHello{.token = 9, .schema = testTypes().schema()}));
    bool closed = false;
    raw.readAll(&closed);
    EXPECT_TRUE(closed);
    EXPECT_TRUE(server.waitUntil([](const Seen& s) { return s.left.size() == 1; }));
    EXPECT_NE(server.seen().left.at(0).find("no bulk connection within 150 ms"), std::string::npos);
    expectStillServing(server);
}

// Cut off without a word: the server finds out when somebody else comes.
TEST(Handshake, AClientThatFellSilentGivesWayToTheNext) {
    TestServer server{"left"};
    RawSocket silent{server.port()};
    silent.send(packet(wire::ClientHello{.token = 9, .schema = testTypes().schema()}));
    ASSERT_TRUE(server.waitUntil([](const Seen& s) { return s.joined == 1; }));
    RawSocket bulk{server.port()};
    bulk.send(packet(wire::ClientHello{.role = wire::Role::bulk, .token = 9}));
    TestHub hub;
    hub->connect(server.address());
    // Long before the 30 s after which the server gives it up by itself.
    const auto joined = hub->waitForAll({}, in(20s));
    EXPECT_TRUE(joined) << joined.error().what;
    EXPECT_EQ(server.seen().left.size(), 1U);
    EXPECT_NE(server.seen().left.at(0).find("it was silent for "), std::string::npos);
}

TEST(Handshake, AServerThatSaysNothingIsGivenUpAfterStartTimeout) {
    const DeafListener deaf;
    TestHub hub{{.startTimeout = 150ms}};
    hub->connect({.name = "deaf", .host = "127.0.0.1", .port = deaf.port()});
    const auto limit = eventually();
    while (!hub.logContains("no answer to Hello within 150 ms") && SteadyClock::now() < limit)
        ASSERT_FALSE(hub->waitForAll({}, in(50ms)));
    EXPECT_TRUE(hub.logContains("deaf (127.0.0.1:"));
}

std::string listenError(ServerOptions options) {
    field::TypeRegistry types;
    try {
        const ServerHost host{std::move(options), types};
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().code, Errc::config);
        return failure.what();
    }
    return "(none)";
}

TEST(Handshake, APortThatIsTakenIsOneClearError) {
    TestServer server{"left"};
    const auto text = listenError({.port = server.port(), .name = "other"});
    EXPECT_NE(
        text.find("server \"other\": cannot listen on 127.0.0.1:" + std::to_string(server.port())),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("in use"), std::string::npos) << text;
}

TEST(Handshake, OnlyLoopbackIsListenedOnWithoutAKey) {
    EXPECT_NE(listenError({.address = "0.0.0.0"}).find("key"), std::string::npos);
    EXPECT_NE(listenError({.address = "wall-left"}).find("not a numeric"), std::string::npos);
    EXPECT_EQ(listenError({.address = "::1"}), "(none)");
}

}  // namespace
}  // namespace gnomon::net::test
