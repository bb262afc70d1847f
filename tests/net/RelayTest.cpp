// Payloads that go down a tree of servers.
#include <gtest/gtest.h>

#include <algorithm>

#include "Servers.h"

namespace gnomon::net::test {
namespace {

constexpr std::size_t payloadBytes = std::size_t{3} << 20U;

/// Each is there before the next one comes: with relay = 1 a chain.
void connectInTurn(TestHub& hub, Servers& servers) {
    for (TestServer& server : servers) {
        hub->connect(server.address());
        ASSERT_TRUE(hub->waitForAll({}, eventually()));
    }
}

/// Servers by the one that passes payloads on to them; "" is the client.
std::map<std::string, std::vector<std::string>> treeOf(ClientHub& hub) {
    std::map<std::string, std::vector<std::string>> tree;
    for (const auto& status : hub.status()) tree[status.relay].push_back(status.address.name);
    return tree;
}

TEST(Relay, TheClientSendsAPayloadToAsManyServersAsItWasTold) {
    Servers servers{13};
    TestHub hub{{.timeout = 10s, .relay = 3}};
    field::Aspect aspect{hub.types(), 2};
    std::mt19937 random{1};
    const Thing& first = aspect.create<Thing>();
    field::edit(first)->data = randomPayload(random, payloadBytes);
    hub->frame(aspect.commit(), 0);
    for (TestServer& server : servers) hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    const auto tree = treeOf(*hub.operator->());
    EXPECT_EQ(tree.at("").size(), 3U);
    for (const auto& [relay, behind] : tree) EXPECT_LE(behind.size(), 3U) << relay;
    const auto joined = hub->totals().bulkBytes;
    // Payload to three, and a small snapshot to all.
    EXPECT_GE(joined, 3 * payloadBytes);
    EXPECT_LT(joined, 4 * payloadBytes);

    // One that comes with a frame goes the same way.
    const Thing& second = aspect.create<Thing>();
    field::edit(second)->data = randomPayload(random, payloadBytes);
    const auto n = hub->frame(aspect.commit(), 0).n;
    hub->frame({}, 0);
    const auto sent = hub->totals().bulkBytes - joined;
    EXPECT_GE(sent, 3 * payloadBytes);
    EXPECT_LT(sent, 4 * payloadBytes);
    expectTheSameEverywhere(servers, n, aspect);
}

TEST(Relay, ManyEditsWithPayloadsThatComeAndGoReachEveryServer) {
    Servers servers{7};
    TestHub hub{{.timeout = 10s, .relay = 2}};
    Editor editor{hub.types()};
    for (TestServer& server : servers) hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    std::uint64_t n = 0;
    for (int i = 0; i < 120; ++i) n = hub->frame(editor.edits(4), 0).n;
    hub->frame({}, 0);
    expectTheSameEverywhere(servers, n, editor.aspect());
    EXPECT_EQ(hub->totals().lost, 0U);
}

TEST(Relay, ThoseBehindALostRelayGoOnWithoutIt) {
    Servers servers{7};
    TestHub hub{{.timeout = 10s, .relay = 2}};
    Editor editor{hub.types()};
    for (TestServer& server : servers) hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    std::map<std::string, std::vector<std::string>> tree = treeOf(*hub.operator->());
    const auto lost = std::find_if(servers.begin(), servers.end(), [&](const TestServer& server) {
        return tree.contains(server.name());
    });
    ASSERT_NE(lost, servers.end());
    // In the midst of payloads.
    std::uint64_t n = 0;
    for (int i = 0; i < 20; ++i) n = hub->frame(editor.edits(4), 0).n;
    lost->kill();
    for (int i = 0; i < 60; ++i) n = hub->frame(editor.edits(4), 0).n;
    hub->frame({}, 0);
    expectTheSameEverywhere(servers, n, editor.aspect(), &*lost);
    EXPECT_EQ(hub->totals().lost, 1U);
    tree = treeOf(*hub.operator->());
    EXPECT_FALSE(tree.contains(lost->name()));
}

TEST(Relay, ALostRelayInTheMidstOfALargePayloadIsMadeUpFor) {
    Servers servers{4};
    TestHub hub{{.timeout = 20s, .relay = 1}};  // a chain
    field::Aspect aspect{hub.types(), 2};
    ASSERT_NO_FATAL_FAILURE(connectInTurn(hub, servers));
    ASSERT_EQ(treeOf(*hub.operator->()).at(servers[0].name()),
              std::vector<std::string>{servers[1].name()});
    std::mt19937 random{1};
    const Thing& thing = aspect.create<Thing>();
    field::edit(thing)->data = randomPayload(random, std::size_t{48} << 20U);
    const auto n = hub->frame(aspect.commit(), 0).n;  // returns while it is on its way
    servers[0].kill();
    hub->frame({}, 0);
    hub->frame({}, 0);
    expectTheSameEverywhere(servers, n, aspect, &servers[0]);
    EXPECT_EQ(hub->totals().lost, 1U);
}

TEST(Relay, ALostRelayIsMadeUpForWhenTheNextFrameReleasesWhatItWasPassingOn) {
    Servers servers{3};
    TestHub hub{{.timeout = 20s, .relay = 1}};  // a chain
    field::Aspect aspect{hub.types(), 2};
    ASSERT_NO_FATAL_FAILURE(connectInTurn(hub, servers));
    std::mt19937 random{1};
    const Thing& thing = aspect.create<Thing>();
    field::edit(thing)->data = randomPayload(random, std::size_t{48} << 20U);
    hub->frame(aspect.commit(), 0);  // returns while it is on its way
    field::edit(thing)->data = field::Payload{};
    servers[0].kill();
    const auto n = hub->frame(aspect.commit(), 0).n;
    hub->frame({}, 0);
    expectTheSameEverywhere(servers, n, aspect, &servers[0]);
    EXPECT_EQ(hub->totals().lost, 1U);
}

TEST(Relay, AServerThatComesLateGetsWhatWasSentBefore) {
    Servers servers{3};
    TestHub hub{{.timeout = 10s, .relay = 1}};
    Editor editor{hub.types()};
    hub->connect(servers[0].address());
    hub->connect(servers[1].address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int i = 0; i < 40; ++i) hub->frame(editor.edits(4), 0);
    hub->connect(servers[2].address());
    std::uint64_t n = 0;
    for (int i = 0; i < 40; ++i) n = hub->frame(editor.edits(4), 0).n;
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    n = hub->frame(editor.edits(4), 0).n;
    hub->frame({}, 0);
    expectTheSameEverywhere(servers, n, editor.aspect());
}

}  // namespace
}  // namespace gnomon::net::test
