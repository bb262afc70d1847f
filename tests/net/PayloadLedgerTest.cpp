#include <gtest/gtest.h>

#include "PayloadLedger.h"
#include "SerialSet.h"

namespace gnomon::net {
namespace {

field::Payload payload(int value) { return field::Payload{{static_cast<std::byte>(value)}}; }

TEST(PayloadLedger, UploadsEachOnceUntilItIsReleased) {
    PayloadLedger ledger;
    std::vector<PayloadLedger::Kept> fresh;
    const field::ChangeList list{.payloads = {payload(1), payload(1), payload(2)}};
    EXPECT_EQ(ledger.take(list, 1, fresh).size(), 2U);
    EXPECT_EQ(fresh.size(), 2U);
    EXPECT_EQ(ledger.take(list, 2, fresh).size(), 2U);  // named again, not uploaded again
    EXPECT_EQ(fresh.size(), 2U);
    const auto first = fresh[0].serial;

    const auto released = ledger.release({payload(1).hash(), payload(9).hash()}, 3, false);
    ASSERT_EQ(released.size(), 1U);
    EXPECT_EQ(released[0].serial, first);
    EXPECT_EQ(ledger.names().size(), 1U);
    fresh.clear();
    ledger.take(list, 3, fresh);
    ASSERT_EQ(fresh.size(), 1U);
    EXPECT_NE(fresh[0].serial, first);
    EXPECT_EQ(ledger.since(0, 3).size(), 2U);
    ASSERT_EQ(ledger.since(2, 3).size(), 1U);  // needed by frame 3 first
    EXPECT_EQ(ledger.since(2, 3)[0].serial, ledger.newest());
}

TEST(PayloadLedger, HoldsWhatWasReleasedUntilAllHaveAppliedTheFrame) {
    PayloadLedger ledger;
    std::vector<PayloadLedger::Kept> fresh;
    ledger.take({.payloads = {payload(1), payload(2)}}, 4, fresh);
    EXPECT_EQ(ledger.release({payload(1).hash()}, 5, true).size(), 1U);
    EXPECT_TRUE(ledger.holdsAny());
    // One that is ready for frame 3 applies frame 4 before 5, and needs both.
    EXPECT_EQ(ledger.since(3, 3).size(), 2U);
    EXPECT_EQ(ledger.since(3, 3)[0].released, 5U);
    EXPECT_EQ(ledger.since(4, 4).size(), 0U);  // has had both
    EXPECT_EQ(ledger.since(0, 5).size(), 1U);  // begins with frame 5
    EXPECT_EQ(ledger.names().size(), 1U);
    ledger.forget(4);
    EXPECT_TRUE(ledger.holdsAny());
    ledger.forget(5);
    EXPECT_FALSE(ledger.holdsAny());
    EXPECT_EQ(ledger.since(3, 3).size(), 1U);
}

TEST(SerialSet, StaysSmallWhenSerialsComeInTurn) {
    SerialSet set;
    for (std::uint64_t serial = 1; serial <= 10'000; ++serial)
        if (serial % 1000 != 0) {
            EXPECT_TRUE(set.insert(serial));
        }
    EXPECT_EQ(set.intervals(), 10U);
    EXPECT_FALSE(set.insert(999));
    EXPECT_FALSE(set.contains(1000));
    EXPECT_TRUE(set.contains(1001));
}

}  // namespace
}  // namespace gnomon::net
