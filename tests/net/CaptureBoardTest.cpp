#include <gtest/gtest.h>

#include "CaptureBoard.h"

namespace gnomon::net {
namespace {

TEST(CaptureBoard, WaitsForTheCountAndThePicturesInEitherOrder) {
    CaptureBoard board;
    board.begin(7, {"a", "b"});
    board.add("a", {.n = 7});
    board.expect(7, "a", 1);
    board.expect(7, "b", 2);
    board.add("b", {.n = 7});
    board.shown(7);
    EXPECT_FALSE(board.take(7));
    EXPECT_EQ(board.waitingFor(7), "b");
    board.add("b", {.n = 7});
    const auto taken = board.take(7);
    ASSERT_TRUE(taken && *taken);
    EXPECT_EQ((*taken)->size(), 3U);
}

TEST(CaptureBoard, AServerThatGaveItsPicturesMayGo) {
    CaptureBoard board;
    board.begin(7, {"a"});
    board.expect(7, "a", 1);
    board.add("a", {.n = 7});
    board.lost("a");
    board.shown(7);
    const auto taken = board.take(7);
    ASSERT_TRUE(taken);
    EXPECT_TRUE(*taken);
}

TEST(CaptureBoard, StopsAServerThatSendsPicturesWithoutEnd) {
    CaptureBoard board{1'000'000};
    board.begin(7, {"a", "b"});
    const auto picture = [] { return Image{.n = 7, .pixels = std::vector<std::uint8_t>(1000)}; };
    int taken = 0;
    while (taken < 1000 && board.add("a", picture())) ++taken;
    EXPECT_GT(taken, 500);
    EXPECT_LT(taken, 1000);
    EXPECT_TRUE(board.add("b", picture())) << "each has its own";
    EXPECT_TRUE(board.add("a", {.n = 6})) << "nobody waits for that one";
}

TEST(CaptureBoard, KeepsTheNewestTwo) {
    CaptureBoard board;
    for (std::uint64_t n = 1; n <= 3; ++n) {
        board.begin(n, {});
        board.shown(n);
    }
    EXPECT_FALSE(*board.take(1));
    EXPECT_TRUE(*board.take(2));
    EXPECT_TRUE(*board.take(3));
}

}  // namespace
}  // namespace gnomon::net
