// Servers that come late, and come back.
#include <gtest/gtest.h>

#include <algorithm>

#include "TestServer.h"

namespace gnomon::net::test {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(Join, InTheMiddleOfARunBeginsWithTheStateOfThatMoment) {
    TestServer first{"first"}, late{"late"};
    TestHub hub{{.digestEvery = 4}};
    Editor editor{hub.types()};
    hub->connect(first.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    std::map<std::uint64_t, std::uint64_t> expected;
    std::uint64_t last = 0;
    bool joined = false;
    const auto drive = [&] {
        auto changes = editor.edits(4);
        const auto digest = editor.aspect().digest();
        const auto result = hub->frame(std::move(changes), 0);
        expected[last = result.n] = digest;
        joined = joined || contains(result.joinedNow, "late");
    };
    for (int n = 0; n < 30; ++n) drive();
    hub->connect(late.address());
    const auto limit = eventually();
    while (!joined && SteadyClock::now() < limit) drive();
    ASSERT_TRUE(joined);
    for (int n = 0; n < 30; ++n) drive();
    ASSERT_TRUE(
        late.waitUntil([&](const Seen& s) { return !s.swaps.empty() && s.swaps.back() == last; }));

    const Seen seen = late.seen();
    EXPECT_EQ(seen.error, "");
    ASSERT_EQ(seen.snapshots.size(), 1U);
    EXPECT_GE(seen.snapshots[0], 30U);
    ASSERT_FALSE(seen.frames.empty());
    EXPECT_EQ(seen.frames.front(), seen.snapshots[0] + 1);  // no gap
    for (const auto& [n, digest] : seen.digests) EXPECT_EQ(digest, expected.at(n)) << n;
    EXPECT_FALSE(hub.logContains("drifted"));
    EXPECT_EQ(first.seen().error, "");
}

TEST(Join, TheWallDoesNotWaitForAServerThatLoads) {
    TestServer first{"first"}, loading{"loading"};
    loading.stallAt(0);  // its first picture takes for ever
    TestHub hub{{.timeout = 30s, .startTimeout = 60s}};
    hub->connect(first.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->connect(loading.address());
    ASSERT_TRUE(loading.waitUntil([](const Seen& s) { return !s.snapshots.empty(); }));
    const auto began = SteadyClock::now();
    for (int n = 0; n < 100; ++n) hub->frame({}, 0);
    EXPECT_LT(SteadyClock::now() - began, 20s);  // one wait would be 30 s
    const auto error = hub->waitForAll({}, in(50ms));
    ASSERT_FALSE(error);
    EXPECT_EQ(error.error().code, Errc::timeout);
    EXPECT_NE(error.error().what.find("loading (127.0.0.1:"), std::string::npos);
    EXPECT_NE(error.error().what.find("loading", 20), std::string::npos);
    EXPECT_EQ(error.error().what.find("first"), std::string::npos);

    loading.release();
    bool joined = false;
    const auto limit = eventually();
    while (!joined && SteadyClock::now() < limit)
        joined = contains(hub->frame({}, 0).joinedNow, "loading");
    EXPECT_TRUE(joined);
    EXPECT_TRUE(hub->waitForAll({}, eventually()));
}

TEST(Join, AJoinerThatNeverGetsReadyIsGivenUpAfterStartTimeout) {
    TestServer first{"first"}, stuck{"stuck"};
    stuck.stallAt(0);
    TestHub hub{{.startTimeout = 200ms}};
    hub->connect(first.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->connect(stuck.address());
    const auto limit = eventually();
    while (!hub.logContains("stuck (127.0.0.1") && SteadyClock::now() < limit) hub->frame({}, 0);
    EXPECT_TRUE(hub.logContains("for more than 200 ms"));
    stuck.release();
    ASSERT_TRUE(stuck.waitUntil([](const Seen& s) { return !s.left.empty(); }));
}

TEST(Join, ARestartedServerOnAnotherPortComesBack) {
    TestServer stays{"stays"};
    auto restarts = std::make_unique<TestServer>("restarts");
    TestHub hub;
    Editor editor{hub.types()};
    hub->connect(stays.address());
    hub->connect(restarts->address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int n = 0; n < 10; ++n) hub->frame(editor.edits(5), 0);
    restarts->kill();
    restarts = std::make_unique<TestServer>("restarts");
    hub->connect(restarts->address());

    bool dropped = false, joined = false;
    const auto limit = eventually();
    while (!(dropped && joined) && SteadyClock::now() < limit) {
        const auto result = hub->frame(editor.edits(1), 0);
        dropped = dropped || contains(result.droppedNow, "restarts");
        joined = joined || contains(result.joinedNow, "restarts");
    }
    EXPECT_TRUE(dropped);
    EXPECT_TRUE(joined);
    std::uint64_t last = 0;
    std::uint64_t digest = 0;
    for (int n = 0; n < 5; ++n) {
        auto changes = editor.edits(1);
        digest = editor.aspect().digest();
        last = hub->frame(std::move(changes), 0).n;
    }
    ASSERT_TRUE(restarts->waitUntil(
        [&](const Seen& s) { return !s.frames.empty() && s.frames.back() == last; }));
    EXPECT_EQ(restarts->seen().digests.at(last), digest);
    const auto totals = hub->totals();
    EXPECT_EQ(totals.lost, 1U);
    EXPECT_EQ(totals.rejoined, 1U);
    for (const auto& server : hub->status())
        EXPECT_EQ(server.rejoined, server.address.name == "restarts" ? 1U : 0U);
}

TEST(Join, AServerThatIsStillToBeStartedIsTriedAgain) {
    auto probe = std::make_unique<TestServer>("later");
    const auto port = probe->port();
    const auto address = probe->address();
    probe->kill();
    TestHub hub;
    hub->connect(address);
    const auto refused = hub->waitForAll({}, in(200ms));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("later (127.0.0.1:" + std::to_string(port) + ")"),
              std::string::npos);
    EXPECT_NE(refused.error().what.find("refused"), std::string::npos);
    TestServer later{"later", {.port = port}};
    int calls = 0;
    EXPECT_TRUE(hub->waitForAll([&](const auto& servers) { calls += servers.size() == 1 ? 1 : 0; },
                                eventually()));
    EXPECT_GE(calls, 2);
}

TEST(Join, AWallWhoseServersAreAllGoneComesBackWithThem) {
    TestServer only{"only"};
    const auto port = only.port();
    TestHub hub{{.timeout = 100ms}};
    Editor editor{hub.types()};
    hub->connect(only.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->frame(editor.edits(20), 0);
    only.kill();
    for (int n = 0; n < 3; ++n) hub->frame(editor.edits(5), 0);
    TestServer again{"only", {.port = port}};
    bool joined = false;
    std::uint64_t digest = 0, last = 0;
    const auto limit = eventually();
    while (!joined && SteadyClock::now() < limit) {
        auto changes = editor.edits(1);
        digest = editor.aspect().digest();
        const auto result = hub->frame(std::move(changes), 0);
        last = result.n;
        joined = contains(result.joinedNow, "only");
    }
    ASSERT_TRUE(joined);
    ASSERT_TRUE(again.waitUntil([&](const Seen& s) { return s.digests.contains(last); }));
    EXPECT_EQ(again.seen().digests.at(last), digest);
}

}  // namespace
}  // namespace gnomon::net::test
