// Bulk data: addressed by content, shared, and given back when nothing uses it.
#include "TestTypes.h"

namespace gnomon::field::test {
namespace {

TEST(Payload, IsNamedByItsContent) {
    const Payload a = payloadOf("same bytes");
    const Payload b = payloadOf("same bytes");
    EXPECT_EQ(a, b);
    EXPECT_NE(a, payloadOf("other bytes"));
    EXPECT_EQ(a.hash(), contentHash(a.bytes()));
    EXPECT_EQ(a.size(), 10U);
    EXPECT_FALSE(Payload{});
    EXPECT_EQ(Payload{std::vector<std::byte>{}}, Payload{});
    EXPECT_EQ(Payload{}.hash(), Hash128{});
}

TEST(Payload, LeavesOutARemainder) {
    EXPECT_EQ(payloadOf("123456789").as<std::uint32_t>().size(), 2U);
}

TEST(Payload, CostsASecondAspectAPointer) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    edit(item)->data = payloadOf("bulk data");
    pair.exchange();
    const Item* copy = pair.replica.get(Ref<Item>{item.id()});
    ASSERT_NE(copy, nullptr);
    EXPECT_EQ(copy->data->bytes().data(), item.data->bytes().data());
}

TEST(Payload, IsReleasedWhenTheLastFieldLetsGo) {
    Pair pair;
    pair.source.followPayloads();
    pair.replica.followPayloads();
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    const Payload bulk = payloadOf("bulk");
    edit(a)->data = bulk;
    edit(b)->blobs.assign({bulk, bulk});
    pair.exchange();
    edit(a)->data = Payload{};
    edit(b)->blobs.erase(0);
    pair.exchange();
    EXPECT_TRUE(pair.source.takeUnusedPayloads().empty());
    EXPECT_TRUE(pair.replica.takeUnusedPayloads().empty());
    expectApplied(pair.source.destroy(b));
    pair.exchange();
    EXPECT_EQ(pair.source.takeUnusedPayloads(), std::vector{bulk.hash()});
    EXPECT_EQ(pair.replica.takeUnusedPayloads(), std::vector{bulk.hash()});
    EXPECT_TRUE(pair.source.takeUnusedPayloads().empty()) << "told once";
}

TEST(Payload, UsedAgainBeforeItWasAskedForIsNotUnused) {
    Pair pair;
    pair.source.followPayloads();
    const Item& a = pair.source.create<Item>();
    edit(a)->data = payloadOf("bulk");
    edit(a)->data = Payload{};
    edit(a)->data = payloadOf("bulk");
    EXPECT_TRUE(pair.source.takeUnusedPayloads().empty());
}

TEST(Payload, GoesOnceAndIsThenKnown) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    edit(a)->data = payloadOf("bulk");
    pair.exchange();
    edit(b)->data = payloadOf("bulk");  // equal, but bytes of its own
    ChangeList list = pair.source.commit();
    EXPECT_EQ(list.payloads.size(), 1U);
    list.payloads.clear();  // as the network does with what a server has
    expectApplied(pair.replica.apply(list));
    pair.expectEqual();
}

TEST(Payload, StaysKnownWhicheverEqualOneStays) {
    // Aspects hold equal payloads that do not share bytes; one going must not lose the other.
    const TypeRegistry types = itemTypes();
    Aspect replica{types, 0};
    Aspect source{types, 1};
    const Item& a = source.create<Item>();
    const Item& b = source.create<Item>();
    const Item& c = source.create<Item>();
    edit(a)->data = payloadOf("bulk");
    auto list = source.commit();
    list.payloads = {payloadOf("bulk")};
    expectApplied(replica.apply(list));
    edit(b)->data = payloadOf("bulk");
    list = source.commit();
    list.payloads = {payloadOf("bulk")};  // sent twice
    expectApplied(replica.apply(list));
    list = {};
    edit(a)->data = Payload{};
    expectApplied(replica.apply(source.commit()));
    edit(c)->data = payloadOf("bulk");
    list = source.commit();
    list.payloads.clear();
    expectApplied(replica.apply(list));
    EXPECT_EQ(source.digest(), replica.digest());
}

TEST(Payload, ThatHasNotArrivedIsRefused) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    edit(item)->data = payloadOf("bulk");
    ChangeList list = pair.source.commit();
    list.payloads.clear();
    const auto refused = pair.replica.apply(list);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, Errc::protocol);
    EXPECT_NE(refused.error().what.find("has not arrived"), std::string::npos)
        << refused.error().what;
}

TEST(Payload, WhatArrivedUnusedIsForgotten) {
    Pair pair;
    pair.source.create<Item>();
    ChangeList list = pair.source.commit();
    const Payload bulk = payloadOf("never named");
    list.payloads = {bulk};
    expectApplied(pair.replica.apply(list));
    const ChangeList naming = [&] {
        const Item& item = pair.source.create<Item>();
        edit(item)->data = bulk;
        ChangeList made = pair.source.commit();
        made.payloads.clear();
        return made;
    }();
    EXPECT_FALSE(pair.replica.apply(naming).has_value());
}

}  // namespace
}  // namespace gnomon::field::test
