// Payloads that are compressed on their way.
#include <gtest/gtest.h>

#include "Servers.h"

namespace gnomon::net::test {
namespace {

constexpr std::size_t evenBytes = std::size_t{3} << 20U;

field::Payload evenPayload() {
    std::vector<std::byte> bytes(evenBytes);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i / 1000);
    return field::Payload{std::move(bytes)};
}

class Compression : public testing::TestWithParam<int> {};

/// Directly, and through other servers.
TEST_P(Compression, SparesBytesAndChangesNothing) {
    Servers servers{3};
    TestHub hub{{.timeout = 10s, .relay = GetParam(), .compress = Compress::always}};
    field::Aspect aspect{hub.types(), 2};
    for (TestServer& server : servers) hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    const auto sentTo = static_cast<std::uint64_t>(GetParam() > 0 ? GetParam() : 3);

    const Thing& thing = aspect.create<Thing>();
    field::edit(thing)->data = evenPayload();
    auto n = hub->frame(aspect.commit(), 0).n;
    hub->frame({}, 0);
    EXPECT_LT(hub->totals().bulkBytes, sentTo * evenBytes / 20);
    EXPECT_GT(hub->totals().sparedBytes, sentTo * evenBytes * 19 / 20);
    const auto spared = hub->totals().sparedBytes;

    // What does not shrink goes as it is.
    std::mt19937 random{1};
    field::edit(thing)->data = randomPayload(random, evenBytes);
    n = hub->frame(aspect.commit(), 0).n;
    hub->frame({}, 0);
    EXPECT_EQ(hub->totals().sparedBytes, spared);
    EXPECT_GT(hub->totals().bulkBytes, sentTo * evenBytes);
    expectTheSameEverywhere(servers, n, aspect);
}

INSTANTIATE_TEST_SUITE_P(All, Compression, testing::Values(0, 1),
                         [](const auto& info) { return info.param == 0 ? "direct" : "relayed"; });

TEST(Compression, IsNotDoneOnThisMachine) {
    TestServer server{"server"};
    TestHub hub{{.timeout = 10s}};
    field::Aspect aspect{hub.types(), 2};
    hub->connect(server.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    for (int i = 0; i < 5; ++i) {
        field::edit(aspect.create<Thing>())->data = evenPayload();
        hub->frame(aspect.commit(), 0);
    }
    hub->frame({}, 0);
    EXPECT_EQ(hub->totals().sparedBytes, 0U);
}

}  // namespace
}  // namespace gnomon::net::test
