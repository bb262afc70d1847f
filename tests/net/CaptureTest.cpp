#include <gtest/gtest.h>

#include <set>

#include "TestServer.h"

namespace gnomon::net::test {
namespace {

TEST(Capture, BringsEveryServersPicturesOfThatFrame) {
    TestServer left{"left", {.images = 2}}, right{"right", {.images = 1}};
    TestHub hub;
    hub->connect(left.address());
    hub->connect(right.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hub->frame({}, 0);
    const auto n = hub->frame({}, 0, true).n;
    auto images = hub->takeImages(n, eventually());
    ASSERT_TRUE(images) << images.error().what;
    std::multiset<std::string> from;
    for (const TileImage& tile : *images) {
        from.insert(tile.server);
        EXPECT_EQ(tile.image.n, n);
        EXPECT_EQ(tile.image.x, 5U);
        ASSERT_EQ(tile.image.pixels.size(), 700U * 400 * 3);
        EXPECT_EQ(tile.image.pixels.back(), static_cast<std::uint8_t>(n + 1));
    }
    EXPECT_EQ(from, (std::multiset<std::string>{"left", "left", "right"}));
    EXPECT_FALSE(hub->takeImages(n, eventually()));  // taken
    EXPECT_FALSE(hub->takeImages(1, eventually()));  // never captured
}

TEST(Capture, SaysWhoseAreMissing) {
    TestServer left{"left", {.images = 1}}, hangs{"hangs", {.images = 1}};
    TestHub hub{{.timeout = 100ms}};
    hub->connect(left.address());
    hub->connect(hangs.address());
    ASSERT_TRUE(hub->waitForAll({}, eventually()));
    hangs.stallAt(1);
    const auto n = hub->frame({}, 0, true).n;
    const auto images = hub->takeImages(n, eventually());
    ASSERT_FALSE(images);
    EXPECT_EQ(images.error().code, Errc::disconnected);
    EXPECT_NE(images.error().what.find("hangs"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::net::test
