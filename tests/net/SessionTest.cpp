// Frames in step: order, contents, cost.
#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

#include "TestServer.h"

namespace gnomon::net::test {
namespace {

std::vector<std::uint64_t> range(std::uint64_t first, std::uint64_t last) {
    std::vector<std::uint64_t> all(last - first + 1);
    std::iota(all.begin(), all.end(), first);
    return all;
}

class EveryPipeline : public testing::TestWithParam<int> {};

TEST_P(EveryPipeline, FramesComeInStepInOrderAndWithEqualContents) {
    constexpr std::uint64_t frames = 60;
    TestServer left{"left"}, right{"right"};
    TestHub hub{{.pipeline = GetParam(), .digestEvery = 8}};
    Editor editor{hub.types()};
    hub->connect(left.address());
    hub->connect(right.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));

    std::map<std::uint64_t, std::uint64_t> expected;
    for (std::uint64_t n = 1; n <= frames; ++n) {
        auto changes = editor.edits(5);
        expected[n] = editor.aspect().digest();
        const auto result = hub->frame(std::move(changes), static_cast<double>(n) / 60);
        EXPECT_EQ(result.n, n);
        EXPECT_GE(result.shown + static_cast<std::uint64_t>(GetParam()), n);
        EXPECT_TRUE(result.droppedNow.empty());
    }
    for (TestServer* server : {&left, &right}) {
        ASSERT_TRUE(server->waitUntil(
            [&](const Seen& s) { return !s.swaps.empty() && s.swaps.back() == frames; }));
        const Seen seen = server->seen();
        EXPECT_EQ(seen.error, "");
        EXPECT_EQ(seen.frames, range(1, frames));
        // The last frame's swap names every frame once, and the one the server began with never.
        EXPECT_EQ(seen.swaps, range(1, frames));
        for (const auto& [n, digest] : expected) EXPECT_EQ(seen.digests.at(n), digest) << n;
    }
    EXPECT_FALSE(hub.logContains("drifted"));
}

INSTANTIATE_TEST_SUITE_P(Depth, EveryPipeline, testing::Values(0, 1, 2));

TEST(Session, WhatTheHooksWriteTravelsWithTheSameFrame) {
    struct Made {
        const Derived* derived = nullptr;
    };
    auto made = std::make_shared<Made>();
    HubHooks hooks;
    hooks.prepare = [made](field::Aspect& session, const field::Applied&, std::uint64_t n) {
        if (made->derived == nullptr) made->derived = &session.create<Derived>();
        field::edit(*made->derived)->frame = n;
    };
    std::atomic<std::uint64_t> digest{0};
    hooks.wantsDepth = [](const field::Aspect&, std::uint64_t n) { return n % 2 == 0; };
    std::vector<std::pair<float, float>> ranges;
    hooks.fit = [&, made](field::Aspect& session, std::uint64_t, float min, float max) {
        field::edit(*made->derived)->nearest = min;
        ranges.emplace_back(min, max);
        digest = session.digest();
    };
    TestServer near{"a"}, far{"four"};
    TestHub hub{{.digestEvery = 2}, hooks};
    Editor editor{hub.types()};
    hub->connect(near.address());
    hub->connect(far.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 1; n <= 10; ++n) hub->frame(editor.edits(3), 0);
    for (TestServer* server : {&near, &far})
        ASSERT_TRUE(server->waitUntil(
            [&](const Seen& s) { return !s.swaps.empty() && s.swaps.back() == 10; }));
    hub.end();  // the hooks' thread has ended
    ASSERT_EQ(ranges.size(), 5U);
    for (const auto& [min, max] : ranges) {
        EXPECT_EQ(min, 1.0F);
        EXPECT_EQ(max, 40.0F);
    }
    EXPECT_EQ(near.seen().digests.at(10), digest.load());
    EXPECT_EQ(far.seen().digests.at(10), digest.load());
    EXPECT_FALSE(hub.logContains("drifted"));
}

TEST(Session, TheDepthOfAFrameIsToldWithoutWaitingForIt) {
    std::vector<std::tuple<std::uint64_t, float, float>> told;
    HubHooks hooks;
    hooks.tellsDepth = [](const field::Aspect&, std::uint64_t n) { return n % 2 == 0; };
    hooks.depthSeen = [&](std::uint64_t n, float min, float max) {
        told.emplace_back(n, min, max);
    };
    TestServer near{"a"}, far{"four"};
    TestHub hub{{}, hooks};
    Editor editor{hub.types()};
    hub->connect(near.address());
    hub->connect(far.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 1; n <= 10; ++n) hub->frame(editor.moveOne(), 0);
    for (TestServer* server : {&near, &far})
        ASSERT_TRUE(server->waitUntil(
            [&](const Seen& s) { return !s.swaps.empty() && s.swaps.back() == 10; }));
    hub.end();  // the hooks' thread has ended
    ASSERT_EQ(told.size(), 5U);
    for (std::size_t i = 0; i < told.size(); ++i)
        EXPECT_EQ(told[i], std::tuple(2 * (i + 1), 1.0F, 40.0F));
}

TEST(Session, SwapAndNextFrameGoOutInOneWrite) {
    TestServer server{"left"};
    // No frame is Ready before the next one is prepared, as with an application that is ahead.
    HubHooks hooks;
    hooks.prepare = [&](field::Aspect&, const field::Applied&, std::uint64_t n) {
        server.stallAt(n);
    };
    TestHub hub{{.pipeline = 1, .pingInterval = 60s}, hooks};
    Editor editor{hub.types()};
    hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 0; n < 20; ++n) hub->frame(editor.moveOne(), 0);

    constexpr std::uint64_t frames = 200;
    const auto before = hub->totals();
    for (std::uint64_t n = 0; n < frames; ++n) hub->frame(editor.moveOne(), 0);
    const auto after = hub->totals();
    server.release();
    const auto writes = after.controlWrites - before.controlWrites;
    EXPECT_GE(writes, frames);
    EXPECT_LE(writes, frames + 8);  // the first pings fall in here, too
}

TEST(Session, AFrameCostsItsChangesAndLittleElse) {
    TestServer server{"left"};
    TestHub hub;
    Editor editor{hub.types()};
    hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->frame(editor.edits(100), 0);
    hub->frame(editor.moveOne(), 0);
    const auto still = hub->frame({}, 0);
    EXPECT_LE(still.bytes, 64U);
    const auto moved = hub->frame(editor.moveOne(), 0);
    EXPECT_LE(moved.bytes - still.bytes, 96U);
    EXPECT_GE(moved.bytes - still.bytes, 60U);  // the transform itself
}

TEST(Session, APayloadIsUploadedOnceToEachServer) {
    TestServer left{"left"}, right{"right"};
    TestHub hub;
    Editor editor{hub.types()};
    hub->connect(left.address());
    hub->connect(right.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    const auto before = hub->totals().bulkBytes;
    const auto payload = randomPayload(editor.random(), 3'000'000);
    std::vector<const Thing*> things;
    for (int i = 0; i < 5; ++i) {
        things.push_back(&editor.aspect().create<Thing>());
        field::edit(*things.back())->data = payload;
        const auto result = hub->frame(editor.aspect().commit(), 0);
        EXPECT_EQ(result.payloadBytes, i == 0 ? payload.size() : 0U);
    }
    hub->frame({}, 0);
    const auto sent = hub->totals().bulkBytes - before;
    EXPECT_GE(sent, 2 * payload.size());
    EXPECT_LE(sent, 2 * payload.size() + 10'000);

    // Given up and taken back: servers have forgotten it, so it travels again.
    for (const Thing* thing : things) field::edit(*thing)->data = field::Payload{};
    hub->frame(editor.aspect().commit(), 0);
    field::edit(*things.front())->data = payload;
    EXPECT_EQ(hub->frame(editor.aspect().commit(), 0).payloadBytes, payload.size());
    hub->frame({}, 0);
    EXPECT_TRUE(hub->frame({}, 0).droppedNow.empty());
    EXPECT_EQ(left.seen().error, "");
    EXPECT_GE(hub->totals().bulkBytes - before, 4 * payload.size());
}

TEST(Session, ReportsSkewAndInput) {
    TestServer left{"left"}, right{"right"};
    TestHub hub;
    hub->connect(left.address());
    hub->connect(right.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    left.send({.window = 7, .kind = EventKind::key, .code = 65, .action = 1, .x = 2, .y = 3});
    std::optional<double> skew;
    std::vector<InputEventFrom> events;
    for (int i = 0; i < 100'000 && (!skew || events.empty()); ++i) {
        if (const auto now = hub->frame({}, 0).skewMs) skew = now;
        for (auto& event : hub->takeEvents()) events.push_back(std::move(event));
    }
    ASSERT_TRUE(skew);
    EXPECT_GE(*skew, 0.0);
    EXPECT_LT(*skew, 1000.0);  // one clock, after all
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].server, "left");
    EXPECT_EQ(events[0].event.code, 65);
    EXPECT_EQ(events[0].event.window, 7U);
}

TEST(Session, NamesTheServerWhoseCopyDrifts) {
    TestServer honest{"honest"}, drifting{"drifting", {.lieAboutDigest = true}};
    TestHub hub{{.digestEvery = 2}};
    Editor editor{hub.types()};
    hub->connect(honest.address());
    hub->connect(drifting.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    bool dropped = false, back = false;
    const auto limit = eventually();
    while (!back && SteadyClock::now() < limit) {
        const auto result = hub->frame(editor.edits(2), 0);
        dropped |= !result.droppedNow.empty();
        back = dropped && !result.joinedNow.empty();
    }
    EXPECT_TRUE(back);
    EXPECT_TRUE(hub.logContains("its copy of the scene drifted: digest"));
    EXPECT_TRUE(hub.logContains("containers are not as they should be: 1:1 (Derived) differs") ||
                hub.logContains("containers are not as they should be: 2:1 (Thing) differs"));
    EXPECT_TRUE(hub.logContains("to begin anew"));
    EXPECT_FALSE(hub.logContains("honest (127.0.0.1"));
    // It lies on, and is let be.
    for (int n = 0; n < 20; ++n) EXPECT_TRUE(hub->frame(editor.edits(2), 0).droppedNow.empty());
}

TEST(Session, AListThatDoesNotFitIsThrownAtTheCallerAndAfterwardsAgain) {
    TestServer server{"left"};
    TestHub hub;
    Editor editor{hub.types()};
    hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    editor.moveOne();  // a commit that is left out
    EXPECT_THROW(hub->frame(editor.moveOne(), 0), Failure);
    EXPECT_THROW(hub->frame({}, 0), Failure);
}

TEST(Session, WithoutAnyServerAFrameReturnsAfterTheTimeout) {
    TestServer server{"left"};
    const auto address = server.address();
    server.kill();
    TestHub hub{{.timeout = 100ms, .pipeline = 0}};
    hub->connect(address);
    const auto began = SteadyClock::now();
    for (int n = 0; n < 3; ++n) hub->frame({}, 0);
    EXPECT_GE(SteadyClock::now() - began, 300ms);
    EXPECT_LT(SteadyClock::now() - began, 10s);
}

}  // namespace
}  // namespace gnomon::net::test
