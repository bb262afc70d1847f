// Who gets to a server, and who does not, over real sockets.
#include <gnomon/net/Codec.h>
#include <gnomon/net/Probe.h>
#include <gtest/gtest.h>

#include <deque>

#include "RawSocket.h"
#include "TestServer.h"

namespace gnomon::net::test {
namespace {

void expectServing(TestServer& server, const SharedKey& key) {
    TestHub hub{{}, {}, key};
    hub->connect(server.address());
    const auto joined = hub->waitForAll({}, eventually());
    EXPECT_TRUE(joined) << joined.error().what;
}

/// A hub that tries in vain, until it says why.
void expectRefused(TestServer& server, const SharedKey& key, const std::string& why) {
    TestHub hub{{}, {}, key};
    hub->connect(server.address());
    const auto limit = eventually();
    while (!hub.logContains(why) && SteadyClock::now() < limit)
        ASSERT_FALSE(hub->waitForAll({}, in(20ms)));
    EXPECT_TRUE(hub.logContains(why)) << testing::PrintToString(hub.log());
    EXPECT_EQ(server.seen().joined, 0);
}

TEST(Security, ClientAndServerWithTheSameKeyTakePart) {
    TestServer left{"left", {.images = 1, .key = testKey()}}, right{"right", {.key = testKey()}};
    TestHub hub{{.digestEvery = 4}, {}, testKey()};
    Editor editor{hub.types()};
    hub->connect(left.address());
    hub->connect(right.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 0; n < 20; ++n) EXPECT_TRUE(hub->frame(editor.edits(10), 0).droppedNow.empty());
    // Bulk in both directions: payloads are among the edits, and a picture comes back.
    const auto last = hub->frame(editor.edits(10), 0, true);
    const auto images = hub->takeImages(last.n, eventually());
    ASSERT_TRUE(images) << images.error().what;
    ASSERT_EQ(images->size(), 1U);
    EXPECT_EQ(images->front().image.pixels.back(), static_cast<std::uint8_t>(last.n + 1));
    EXPECT_EQ(left.seen().error, "");
    EXPECT_FALSE(hub.logContains("drifted"));
    EXPECT_GT(hub->totals().bulkBytes, 1000U);
}

TEST(Security, AnotherKeyIsRefusedAndNamed) {
    TestServer server{"left", {.key = testKey('1')}};
    expectRefused(server, testKey('2'), "does not accept the cluster key");
    EXPECT_TRUE(server.turnedAway("another cluster key (" + testKey('2')->fingerprint()));
    expectServing(server, testKey('1'));
}

TEST(Security, AClientWithoutAKeyIsToldThatOneIsNeeded) {
    TestServer server{"left", {.key = testKey()}};
    expectRefused(server, {}, "a cluster key is needed on this side, too");
    EXPECT_TRUE(server.turnedAway("it has no cluster key"));
    expectServing(server, testKey());
}

TEST(Security, AServerWithoutAKeyIsNotSpokenToByAClientWithOne) {
    TestServer server{"left", {.key = {}}};
    expectRefused(server, testKey(), "has it the cluster key?");
    EXPECT_TRUE(server.turnedAway("it speaks TLS"));
    expectServing(server, {});
}

TEST(Security, PlainMessagesReachNoDecoder) {
    TestServer server{"left", {.key = testKey()}};
    RawSocket raw{server.port()};
    raw.send(packet(wire::ClientHello{.token = 9, .schema = testTypes().schema()}));
    bool closed = false;
    const auto reply = raw.readAll(&closed);
    EXPECT_TRUE(closed);
    EXPECT_LE(reply.size(), 7U);  // an alert at most
    EXPECT_EQ(server.seen().joined, 0);
    expectServing(server, testKey());
}

TEST(Security, AHandshakeThatIsCutOffHarmsNobody) {
    TestServer server{"left", {.key = testKey()}};
    {
        RawSocket raw{server.port()};
        const std::byte begun[] = {std::byte{22}, std::byte{3}, std::byte{1},
                                   std::byte{1},  std::byte{0}, std::byte{1}};
        raw.send(begun);
    }
    EXPECT_TRUE(server.turnedAway("within the TLS handshake"));
    expectServing(server, testKey());
}

TEST(Security, ASlowHandshakeIsEndedInTime) {
    TestServer server{"left", {.handshakeTimeout = 150ms, .key = testKey()}};
    RawSocket raw{server.port()};
    const std::byte begun[] = {std::byte{22}, std::byte{3}, std::byte{1}};
    raw.send(begun);
    bool closed = false;
    EXPECT_TRUE(raw.readAll(&closed).empty());
    EXPECT_TRUE(closed);
    EXPECT_TRUE(server.turnedAway("no end of the TLS handshake within 150 ms"));
}

TEST(Security, AnEndlessHandshakeIsEnded) {
    TestServer server{"left", {.handshakeTimeout = 600s, .key = testKey()}};
    RawSocket raw{server.port()};
    // A hello that promises 16 KiB, a byte a record.
    const std::byte begun[] = {std::byte{22}, std::byte{3},    std::byte{1},
                               std::byte{0},  std::byte{4},    std::byte{1},
                               std::byte{0},  std::byte{0x3f}, std::byte{0xff}};
    const std::byte more[] = {std::byte{22}, std::byte{3}, std::byte{1},
                              std::byte{0},  std::byte{1}, std::byte{3}};
    raw.send(begun);
    for (int i = 0; i < 4000; ++i) raw.send(more);
    bool closed = false;
    raw.readAll(&closed);
    EXPECT_TRUE(closed);
    EXPECT_TRUE(server.turnedAway("a TLS handshake of more than 16384 bytes"));
}

TEST(Security, AServerThatNeverShakesHandsIsGivenUp) {
    const DeafListener deaf;
    TestHub hub{{.startTimeout = 150ms}, {}, testKey()};
    hub->connect({.name = "deaf", .host = "127.0.0.1", .port = deaf.port()});
    const auto limit = eventually();
    while (!hub.logContains("no end of the TLS handshake") && SteadyClock::now() < limit)
        ASSERT_FALSE(hub->waitForAll({}, in(20ms)));
    EXPECT_TRUE(hub.logContains("no end of the TLS handshake"));
}

TEST(Security, WhoOnlyHoldsPlacesKeepsNobodyOut) {
    for (const SharedKey& key : {SharedKey{}, testKey()}) {
        TestServer server{"left", {.handshakeTimeout = 600s, .key = key}};
        std::deque<RawSocket> idle;
        for (int i = 0; i < 40; ++i) idle.emplace_back(server.port());
        expectServing(server, key);
        // The oldest went, the youngest may stay.
        bool closed = false;
        idle.front().readAll(&closed);
        EXPECT_TRUE(closed);
        EXPECT_TRUE(server.turnedAway("more than 16 connections on their way in"));
    }
}

/// Stands between client and server and writes down what the client sends.
class Recorder {
public:
    explicit Recorder(std::uint16_t server) : server_{server} {
        thread_ = std::thread{[this] {
            RawSocket client = listener_.accept();
            RawSocket behind{server_};
            // One step each: the client's hello, the server's answer, the client's proof and Hello.
            auto hello = client.read(100);
            behind.send(hello);
            client.send(behind.read(100));
            auto proof = client.read(100);
            behind.send(proof);
            client.send(behind.read(50));
            sent_ = std::move(hello);
            proofAt_ = sent_.size();
            sent_.insert(sent_.end(), proof.begin(), proof.end());
        }};
    }
    ~Recorder() { finish(); }
    void finish() {
        if (thread_.joinable()) thread_.join();
    }
    std::uint16_t port() const { return listener_.port(); }
    std::span<const std::byte> hello() const { return std::span{sent_}.first(proofAt_); }
    std::span<const std::byte> proof() const { return std::span{sent_}.subspan(proofAt_); }

private:
    const std::uint16_t server_;
    DeafListener listener_;
    std::vector<std::byte> sent_;
    std::size_t proofAt_ = 0;
    std::thread thread_;
};

TEST(Security, ReplayedBytesBeginNoSession) {
    TestServer server{"left", {.key = testKey()}};
    Recorder recorder{server.port()};
    {
        TestHub hub{{}, {}, testKey()};
        hub->connect({.name = "left", .host = "127.0.0.1", .port = recorder.port()});
        ASSERT_TRUE(server.waitUntil([](const Seen& s) { return s.joined == 1; }));
        recorder.finish();
    }
    ASSERT_TRUE(server.waitUntil([](const Seen& s) { return s.left.size() == 1; }));
    ASSERT_GT(recorder.proof().size(), 50U);
    RawSocket raw{server.port()};
    raw.send(recorder.hello());
    EXPECT_GT(raw.read(100).size(), 100U);  // with a secret of its own
    raw.send(recorder.proof());
    bool closed = false;
    raw.readAll(&closed);
    EXPECT_TRUE(closed);
    EXPECT_EQ(server.seen().joined, 1);
    expectServing(server, testKey());
}

TEST(Security, AProbeFindsOutWhoHasTheKeyAndDisturbsNobody) {
    TestServer same{"same", {.key = testKey()}}, other{"other", {.key = testKey('2')}};
    TestServer none{"none", {.key = {}}};
    const DeafListener deaf;
    const auto answers = probe({same.address(),
                                other.address(),
                                none.address(),
                                {.name = "deaf", .host = "127.0.0.1", .port = deaf.port()},
                                {.name = "nobody", .host = "127.0.0.1", .port = 1}},
                               testKey(), 300ms);
    ASSERT_EQ(answers.size(), 5U);
    EXPECT_TRUE(answers[0]) << answers[0].error().what;
    const char* expected[] = {"", "does not accept the cluster key", "has it the cluster key?",
                              "no answer within 300 ms", "refused"};
    for (std::size_t i = 1; i < answers.size(); ++i) {
        ASSERT_FALSE(answers[i]) << i;
        EXPECT_NE(answers[i].error().text().find(expected[i]), std::string::npos)
            << answers[i].error().text();
    }
    EXPECT_EQ(same.seen().joined, 0);
    const auto plain =
        probe({none.address(), {.name = "far", .host = "192.0.2.1", .port = 7430}}, {}, 5000ms);
    EXPECT_TRUE(plain[0]);
    EXPECT_FALSE(plain[1]);
}

TEST(Security, OtherComputersAreOnlySpokenToWithAKey) {
    TestHub hub;
    // Where nobody is, by RFC 5737; without the refusal this would take seconds.
    hub->connect({.name = "far", .host = "192.0.2.1", .port = 7430});
    const auto limit = eventually();
    while (!hub.logContains("only spoken to with a cluster key") && SteadyClock::now() < limit)
        ASSERT_FALSE(hub->waitForAll({}, in(20ms)));
    EXPECT_TRUE(hub.logContains("far (192.0.2.1:7430)"));
}

TEST(Security, ListeningForOtherComputersNeedsAKey) {
    field::TypeRegistry types;
    EXPECT_THROW((ServerHost{{.address = "0.0.0.0"}, types}), Failure);
    EXPECT_THROW((ServerHost{{.address = "::"}, types}), Failure);
    EXPECT_NO_THROW((ServerHost{{.address = "::ffff:127.0.0.1"}, types}));
    EXPECT_NO_THROW((ServerHost{{.address = "0.0.0.0", .key = testKey()}, types}));
}

}  // namespace
}  // namespace gnomon::net::test
