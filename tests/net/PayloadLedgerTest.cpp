#include <gtest/gtest.h>

#include "PayloadLedger.h"

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

    const auto released = ledger.release({payload(1).hash(), payload(9).hash()});
    ASSERT_EQ(released.size(), 1U);
    EXPECT_EQ(released[0].serial, first);
    EXPECT_EQ(ledger.names().size(), 1U);
    fresh.clear();
    ledger.take(list, 3, fresh);
    ASSERT_EQ(fresh.size(), 1U);
    EXPECT_NE(fresh[0].serial, first);
    EXPECT_EQ(ledger.since(0).size(), 2U);
    ASSERT_EQ(ledger.since(2).size(), 1U);  // needed by frame 3 first
    EXPECT_EQ(ledger.since(2)[0].serial, ledger.newest());
}

}  // namespace
}  // namespace gnomon::net
