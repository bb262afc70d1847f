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
