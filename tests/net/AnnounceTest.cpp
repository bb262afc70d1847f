// Servers found by name, over loopback.
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/Lookup.h>
#include <gnomon/net/ServerMessages.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "Announcers.h"
#include "Datagrams.h"
#include "RawSocket.h"
#include "TestServer.h"

namespace gnomon::net::test {
namespace {

class Announce : public testing::Test {
protected:
    void SetUp() override {
        const auto why = whyNoMulticast();
        if (!why.empty()) GTEST_SKIP() << why;
    }
    ServerAddress left() const { return {.name = "left", .lookup = group}; }
    /// Tells everybody that the name is at this port.
    static FakeAnnouncer::Answer claim(std::uint16_t port,
                                       std::uint32_t version = protocolVersion) {
        return [=](std::span<const std::byte> bytes) -> std::vector<std::byte> {
            const auto asked = decodeDatagram<wire::Lookup>(Route::toServerLookup, bytes);
            if (!asked) return {};
            return datagram(wire::Announcement{.version = version,
                                               .token = asked->token,
                                               .instance = 666,
                                               .port = port,
                                               .server = asked->server});
        };
    }
    /// Waits for everybody, and shows frames, until the log says so.
    static bool says(TestHub& hub, const std::string& text) {
        const auto limit = eventually();
        while (!hub.logContains(text) && SteadyClock::now() < limit)
            if (hub->waitForAll({}, in(20ms))) hub->frame({}, 0);
        return hub.logContains(text);
    }
    const std::string group = lookupGroup();
};

TEST_F(Announce, AServerIsFoundByItsName) {
    TestServer right{"right", {.announce = group}}, left{"left", {.announce = group}};
    TestHub hub;
    hub->connect(this->left());
    const auto joined = hub->waitForAll({}, eventually());
    ASSERT_TRUE(joined) << joined.error().what;
    const auto status = hub->status();
    EXPECT_EQ(status[0].address.port, left.port());
    EXPECT_EQ(status[0].address.host, "127.0.0.1");
    EXPECT_EQ(right.seen().joined, 0);
    EXPECT_TRUE(hub.logContains("waiting for an announcement of \"left\" on " + group + " (udp)"));
    EXPECT_TRUE(hub.logContains("left (127.0.0.1:" + std::to_string(left.port()) + "): found"));
}

TEST_F(Announce, WhoComesLaterIsFoundToo) {
    const FakeAnnouncer counts{group, [](auto) { return std::vector<std::byte>{}; }};
    TestHub hub;
    hub->connect(left());
    while (counts.heard() < 2) {
        const auto joined = hub->waitForAll({}, in(20ms));
        ASSERT_FALSE(joined);
        EXPECT_NE(joined.error().what.find("left (looked up): waiting for an announcement"),
                  std::string::npos)
            << joined.error().what;
    }
    EXPECT_EQ(hub->status()[0].state, ServerState::looking);
    const TestServer server{"left", {.announce = group}};
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
}

TEST_F(Announce, AServerOnAnotherPortIsFoundAgain) {
    // Two ports at once: they differ.
    const auto ports = [] {
        const DeafListener one, other;
        return std::pair{one.port(), other.port()};
    }();
    TestServer server{"left", {.port = ports.first, .announce = group}};
    TestHub hub{{.timeout = 200ms}};
    hub->connect(left());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->frame({}, 0);
    server.kill();
    TestServer again{"left", {.port = ports.second, .announce = group}};
    bool joined = false;
    const auto limit = eventually();
    while (!joined && SteadyClock::now() < limit) joined = !hub->frame({}, 0).joinedNow.empty();
    EXPECT_TRUE(joined);
    EXPECT_EQ(hub->status()[0].address.port, ports.second);
    EXPECT_EQ(hub->status()[0].rejoined, 1U);
    EXPECT_FALSE(hub.logContains("two servers"));
}

TEST_F(Announce, TwoServersOfOneNameAreNamedTogether) {
    const TestServer one{"left", {.announce = group}}, other{"left", {.announce = group}};
    TestHub hub;
    hub->connect(left());
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
    ASSERT_TRUE(says(hub, "two servers have this name"));
    for (const auto* server : {&one, &other})
        EXPECT_TRUE(hub.logContains("127.0.0.1:" + std::to_string(server->port())));
    EXPECT_EQ(one.seen().joined + other.seen().joined, 1);
}

TEST_F(Announce, OfAnotherVersionIsNamedWithBothNumbers) {
    const FakeAnnouncer fake{group, claim(7430, 77)};
    TestHub hub;
    hub->connect(left());
    EXPECT_TRUE(
        says(hub, "left (127.0.0.1:7430): it answers with protocol version 77, expected 1"));
    EXPECT_TRUE(hub->status()[0].unfit);
    // It does not keep the right one out.
    const TestServer server{"left", {.announce = group}};
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
    EXPECT_FALSE(hub->status()[0].unfit);
}

/// Who lies costs the handshake that he fails in, and no more.
TEST_F(Announce, ALiarFailsInTheHandshakeAndOthersAreTried) {
    const TestServer thief{"left", {.key = testKey('2')}};
    const FakeAnnouncer liar{group, claim(thief.port())};
    TestHub hub{{}, {}, testKey()};
    hub->connect(left());
    ASSERT_TRUE(says(hub, "does not accept the cluster key"));
    const TestServer server{"left", {.key = testKey(), .announce = group}};
    const auto joined = hub->waitForAll({}, eventually());
    ASSERT_TRUE(joined) << joined.error().what;
    EXPECT_EQ(hub->status()[0].address.port, server.port());
    EXPECT_EQ(thief.seen().joined, 0);
}

TEST_F(Announce, ALiarWithoutAServerIsPassedOver) {
    const FakeAnnouncer liar{group, claim(1)};
    TestHub hub;
    hub->connect(left());
    ASSERT_TRUE(says(hub, "left (127.0.0.1:1): "));
    const TestServer server{"left", {.announce = group}};
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
}

TEST_F(Announce, NonsenseIsDroppedAndCounted) {
    TestServer server{"left", {.announce = group}};
    const std::vector<std::byte> nonsense(100, std::byte{7});
    const auto question = datagram(wire::Lookup::padded(5, "left"));
    std::vector<std::vector<std::byte>> all(10, nonsense);
    all.push_back(std::vector<std::byte>(2000, std::byte{1}));
    all.emplace_back();
    all.push_back(question);
    const auto answers = ask(group, all, 1);
    ASSERT_EQ(answers.size(), 1U);
    const auto answer = decodeDatagram<wire::Announcement>(Route::toClientLookup, answers[0]);
    ASSERT_TRUE(answer) << answer.error().what;
    EXPECT_EQ(answer->port, server.port());
    EXPECT_EQ(answer->token, 5U);
    EXPECT_TRUE(server.turnedAway("1 datagram dropped, the last from 127.0.0.1:"));
    EXPECT_TRUE(server.turnedAway("10 datagrams dropped"));
}

TEST_F(Announce, NonsenseInAnswersIsDroppedAndSaidOnce) {
    const FakeAnnouncer fake{group, [](auto) { return std::vector<std::byte>(9); }};
    TestHub hub;
    hub->connect(left());
    while (fake.heard() < 3) ASSERT_FALSE(hub->waitForAll({}, in(20ms)));
    const auto log = hub.log();
    EXPECT_EQ(std::count_if(log.begin(), log.end(),
                            [](const std::string& line) {
                                return line.find("dropped what 127.0.0.1:") != std::string::npos;
                            }),
              1);
    const TestServer server{"left", {.announce = group}};
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
}

TEST_F(Announce, LookUpTellsWhereAllAre) {
    const TestServer one{"left", {.announce = group}}, other{"left", {.announce = group}};
    const TestServer right{"right", {.announce = group}};
    const FakeAnnouncer old{
        group, [&](std::span<const std::byte> bytes) {
            const auto asked = decodeDatagram<wire::Lookup>(Route::toServerLookup, bytes);
            return asked && asked->server == "old" ? claim(7, 0)(bytes) : std::vector<std::byte>{};
        }};
    const auto found = lookUp({"left", "right", "old", "nobody"}, group, false, 2000ms);
    ASSERT_EQ(found.size(), 4U);
    EXPECT_EQ(found[0].places.size(), 2U);
    ASSERT_EQ(found[1].places.size(), 1U);
    EXPECT_EQ(found[1].places[0].port, right.port());
    EXPECT_TRUE(found[2].places.empty());
    EXPECT_NE(found[2].trouble.find("127.0.0.1:7 speaks protocol version 0, expected 1"),
              std::string::npos)
        << found[2].trouble;
    EXPECT_TRUE(found[3].places.empty());
    EXPECT_EQ(found[3].trouble, "");
}

TEST_F(Announce, WhatCannotBeAnnouncedIsSaidAtTheStart) {
    field::TypeRegistry types;
    const auto why = [&](ServerOptions options) -> std::string {
        try {
            const ServerHost host{std::move(options), types};
            return {};
        } catch (const Failure& failure) {
            return failure.what();
        }
    };
    EXPECT_EQ(why({.name = "left", .announce = group}), "");
    EXPECT_NE(why({.name = "left", .announce = "10.0.0.1:7"}).find("multicast group"),
              std::string::npos);
    EXPECT_NE(why({.name = std::string(65, 'a'), .announce = group}).find("65 bytes, at most 64"),
              std::string::npos);
    EXPECT_NE(why({.address = "::1", .name = "left", .announce = group}).find("IPv4"),
              std::string::npos);
}

}  // namespace
}  // namespace gnomon::net::test
