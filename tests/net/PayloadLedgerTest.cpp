#include <gtest/gtest.h>

#include "PayloadLedger.h"

namespace gnomon::net {
namespace {

field::Payload payload(int value) { return field::Payload{{static_cast<std::byte>(value)}}; }

TEST(PayloadLedger, UploadsEachOnceUntilItIsReleased) {
    PayloadLedger ledger;
    std::vector<PayloadLedger::Kept> fresh;
    const field::ChangeList list{.payloads = {payload(1), payload(1), payload(2)}};
    EXPECT_EQ(ledger.take(list, fresh).size(), 2U);
    EXPECT_EQ(fresh.size(), 2U);
    EXPECT_EQ(ledger.take(list, fresh).size(), 2U);  // named again, not uploaded again
    EXPECT_EQ(fresh.size(), 2U);
    const auto first = fresh[0].serial;

    const auto released = ledger.release({payload(1).hash(), payload(9).hash()});
    ASSERT_EQ(released.size(), 1U);
    EXPECT_EQ(released[0].serial, first);
    EXPECT_EQ(ledger.all().size(), 1U);
    fresh.clear();
    ledger.take(list, fresh);
    ASSERT_EQ(fresh.size(), 1U);
    EXPECT_NE(fresh[0].serial, first);
}

}  // namespace
}  // namespace gnomon::net
