// Servers that die, hang or fall silent; clients that do.
#include <gtest/gtest.h>

#include <algorithm>

#include "TestServer.h"

namespace gnomon::net::test {
namespace {

TEST(Loss, AKilledServerCostsNoFrameMoreThanTheTimeout) {
    TestServer stays{"stays"}, dies{"dies"};
    TestHub hub{{.timeout = 300ms}};
    Editor editor{hub.types()};
    hub->connect(stays.address());
    hub->connect(dies.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 0; n < 10; ++n) hub->frame(editor.edits(3), 0);
    std::thread killer{[&] { dies.kill(); }};
    bool dropped = false;
    SteadyClock::duration longest{};
    const auto limit = eventually();
    while (!dropped && SteadyClock::now() < limit) {
        const auto began = SteadyClock::now();
        dropped = !hub->frame(editor.edits(3), 0).droppedNow.empty();
        longest = std::max(longest, SteadyClock::now() - began);
    }
    killer.join();
    EXPECT_TRUE(dropped);
    EXPECT_LT(longest, 300ms + 2s);  // the timeout, and a busy machine's mood
    const auto last = hub->frame(editor.edits(1), 0).n;
    ASSERT_TRUE(stays.waitUntil([&](const Seen& s) { return s.frames.back() == last; }));
    EXPECT_EQ(stays.seen().digests.at(last), editor.aspect().digest());
}

TEST(Loss, AServerThatNeverGetsReadyIsDroppedAfterTheTimeoutAndTheOthersGoOn) {
    TestServer left{"left"}, hangs{"hangs"}, right{"right"};
    TestHub hub{{.timeout = 200ms, .pipeline = 0, .pingInterval = 20ms}};
    for (const auto* server : {&left, &hangs, &right}) hub->connect(server->address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 1; n < 5; ++n) EXPECT_TRUE(hub->frame({}, 0).droppedNow.empty());
    hangs.stallAt(5);
    const auto began = SteadyClock::now();
    const auto result = hub->frame({}, 0);
    const auto took = SteadyClock::now() - began;
    EXPECT_EQ(result.droppedNow, std::vector<std::string>{"hangs"});
    EXPECT_EQ(result.shown, 5U);
    EXPECT_GE(took, 200ms);
    EXPECT_LT(took, 10s);
    EXPECT_TRUE(hub.logContains("hangs (127.0.0.1"));
    EXPECT_TRUE(hub.logContains("dropped at frame 5: not ready"));
    EXPECT_TRUE(hub.logContains("it was at frame 5 for"));

    // The others are at full speed at once, and the one that hung comes back when it lives again.
    for (int n = 0; n < 20; ++n) EXPECT_TRUE(hub->frame({}, 0).droppedNow.empty());
    hangs.release();
    bool joined = false;
    const auto limit = eventually();
    while (!joined && SteadyClock::now() < limit) joined = !hub->frame({}, 0).joinedNow.empty();
    EXPECT_TRUE(joined);
    EXPECT_EQ(hangs.seen().error, "");
}

TEST(Loss, AloneAHangingServerIsGivenTimeButNotForEver) {
    TestServer alone{"alone"};
    TestHub hub{{.timeout = 50ms, .startTimeout = 400ms, .pipeline = 0, .pingInterval = 10ms}};
    hub->connect(alone.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->frame({}, 0);
    alone.stallAt(2);
    const auto began = SteadyClock::now();
    const auto result = hub->frame({}, 0);
    EXPECT_EQ(result.droppedNow, std::vector<std::string>{"alone"});
    EXPECT_GE(SteadyClock::now() - began, 400ms);  // it might have been compiling
    EXPECT_LT(SteadyClock::now() - began, 10s);
}

TEST(Loss, WaitForLateWaits) {
    TestServer left{"left"}, slow{"slow"};
    TestHub hub{{.timeout = 30ms, .waitForLate = true, .pipeline = 0}};
    hub->connect(left.address());
    hub->connect(slow.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    slow.stallAt(1);
    std::thread waker{[&] {
        // Released only after ten timeouts have passed: any drop would have happened by then.
        left.waitUntil([](const Seen& s) { return !s.frames.empty(); });
        const auto until = in(300ms);
        while (SteadyClock::now() < until) std::this_thread::yield();
        slow.release();
    }};
    const auto result = hub->frame({}, 0);
    waker.join();
    EXPECT_TRUE(result.droppedNow.empty());
    EXPECT_EQ(result.waitedFor, "slow");
    EXPECT_GE(result.ms, 250);
}

TEST(Loss, AClientThatSaysGoodbyeIsReportedAndAnotherOneServed) {
    TestServer server{"left"};
    for (int i = 1; i <= 2; ++i) {
        TestHub hub;
        Editor editor{hub.types()};
        hub->connect(server.address());
        ASSERT_TRUE(hub->waitForAll({}, eventually()));
        hub->frame(editor.edits(10), 0);
        hub->shutdown();
        EXPECT_THROW(hub->frame({}, 0), Failure);
        ASSERT_TRUE(server.waitUntil(
            [&](const Seen& s) { return s.left.size() == static_cast<std::size_t>(i); }));
    }
    const Seen seen = server.seen();
    EXPECT_EQ(seen.joined, 2);
    EXPECT_NE(seen.left[0].find("goodbye"), std::string::npos);
    EXPECT_EQ(seen.error, "");
    EXPECT_FALSE(seen.quit);
}

TEST(Loss, ALocalServerEndsWithItsClient) {
    TestServer server{"left", {.exitWithClient = true}};
    {
        TestHub hub;
        hub->connect(server.address());
        ASSERT_TRUE(hub->waitForAll({}, eventually()));
    }
    EXPECT_TRUE(server.waitUntil([](const Seen& s) { return s.quit; }));
}

TEST(Loss, ShutdownDoesNotWaitForAServerThatHangs) {
    TestServer hangs{"hangs"};
    TestHub hub;
    hub->connect(hangs.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hangs.stallAt(1);
    hub->frame({}, 0);
    const auto began = SteadyClock::now();
    hub.end();
    EXPECT_LT(SteadyClock::now() - began, 5s);
}

}  // namespace
}  // namespace gnomon::net::test
