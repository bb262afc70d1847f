// Servers that greet properly and then misbehave.
#include <gnomon/net/Codec.h>
#include <gtest/gtest.h>

#include <optional>

#include "RawSocket.h"
#include "TestServer.h"

namespace gnomon::net::test {
namespace {

/// Says what a server says until it takes part, and from then on only what the test says.
class FakeServer {
public:
    explicit FakeServer(bool ready = true) : ready_{ready} {}
    ServerAddress address() const {
        return {.name = "fake", .host = "127.0.0.1", .port = listener_.port()};
    }
    /// Blocks until the client connected.
    void greet() {
        control_.emplace(listener_.accept());
        control_->read(8);
        control_->send(packet(wire::ServerHello{.server = "fake", .schema = testTypes().schema()}));
        bulk_.emplace(listener_.accept());
        bulk_->read(8);
        if (ready_) control_->send(packet(wire::Ready{.n = 0}));
    }
    RawSocket& control() { return *control_; }
    RawSocket& bulk() { return *bulk_; }

private:
    const bool ready_;
    DeafListener listener_;
    std::optional<RawSocket> control_, bulk_;
};

class Hostile : public testing::Test {
protected:
    /// The honest server and the fake one take part.
    void startBoth() {
        hub_->connect(honest_.address());
        hub_->connect(fake_.address());
        fake_.greet();
        ASSERT_TRUE(hub_->waitForAll({}, eventually()));
    }
    /// The wall drops the fake server and goes on with the honest one.
    void expectDropped(const char* why) {
        bool dropped = false;
        const auto limit = eventually();
        while (!dropped && SteadyClock::now() < limit)
            dropped = hub_->frame({}, 0).droppedNow == std::vector<std::string>{"fake"};
        EXPECT_TRUE(dropped);
        EXPECT_TRUE(hub_.logContains(why)) << (hub_.log().empty() ? "" : hub_.log().back());
        for (int n = 0; n < 5; ++n) EXPECT_TRUE(hub_->frame({}, 0).droppedNow.empty());
    }

    TestServer honest_{"honest"};
    FakeServer fake_;
    TestHub hub_{{.timeout = 300ms, .startTimeout = 60s, .pingInterval = 20ms}};
};

TEST_F(Hostile, ThatFallsSilentIsDropped) {
    startBoth();
    expectDropped("it answers nothing");
}

TEST_F(Hostile, ThatIsKilledIsDroppedAtOnce) {
    startBoth();
    fake_.control().reset();
    expectDropped("fake (127.0.0.1");
}

TEST_F(Hostile, ThatLosesItsBulkConnectionIsDropped) {
    startBoth();
    fake_.bulk().reset();
    expectDropped("fake (127.0.0.1");
}

TEST_F(Hostile, ThatSendsGarbageIsDropped) {
    startBoth();
    fake_.control().send(std::vector<std::byte>(64, std::byte{0xee}));
    expectDropped("not expected here");
}

TEST_F(Hostile, ThatIsReadyForFramesThatWereNeverSentIsDropped) {
    startBoth();
    fake_.control().send(packet(wire::Ready{.n = 1'000'000}));
    expectDropped("Ready 1000000 out of turn");
}

TEST_F(Hostile, ThatAnswersAPingThatWasNeverSentIsDropped) {
    startBoth();
    fake_.control().send(packet(wire::Pong{.sentAt = -1, .serverClock = 1}));
    expectDropped("Pong to a Ping of -1 ns");
}

TEST_F(Hostile, ThatSendsAPictureOutOfOrderIsDropped) {
    startBoth();
    const std::vector<std::byte> pixels(30);
    const wire::Image part{
        .n = 1, .width = 10, .height = 10, .channels = 3, .offset = 50, .tail = pixels};
    fake_.bulk().send(packet(part));
    fake_.bulk().send(pixels);
    expectDropped("found byte 50");
}

TEST(HostileAlone, ThatFallsSilentIsDroppedLongBeforeStartTimeout) {
    FakeServer fake;
    TestHub hub{{.timeout = 100ms, .startTimeout = 600s, .pipeline = 0, .pingInterval = 20ms}};
    hub->connect(fake.address());
    fake.greet();
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    EXPECT_EQ(hub->frame({}, 0).droppedNow, std::vector<std::string>{"fake"});
}

/// It joins, but never reads: what waits for it is bounded.
TEST(HostileJoiner, ThatNeverReadsIsDroppedWhenTooMuchWaits) {
    TestServer honest{"honest"};
    FakeServer fake{false};
    TestHub hub{{.timeout = 30s}};
    hub->connect(honest.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->connect(fake.address());
    fake.greet();
    Editor editor{hub.types()};
    const Thing& thing = editor.aspect().create<Thing>();
    const auto limit = eventually();
    int frames = 0;
    for (; !hub.logContains("it does not read") && SteadyClock::now() < limit; ++frames) {
        const char letter = static_cast<char>('a' + frames % 26);
        field::edit(thing)->text = std::string(std::size_t{1} << 20U, letter);
        hub->frame(editor.aspect().commit(), 0);
    }
    EXPECT_TRUE(hub.logContains("it does not read"));
    EXPECT_GE(frames, 64);
    EXPECT_EQ(honest.seen().error, "");
}

}  // namespace
}  // namespace gnomon::net::test
