// What a change list says, in how many bytes and in which order.
#include <malloc.h>

#include <cmath>

#include "TestTypes.h"

namespace gnomon::field::test {
namespace {

constexpr std::size_t headerBytes = 13;  // u8 version, three u32 counts
constexpr std::size_t changeBytes = 12;  // u64 id, u32 mask

TEST(ChangeList, IsEmptyWhereNothingHappened) {
    Pair pair;
    EXPECT_TRUE(pair.source.commit().empty());
    const Item& item = pair.source.create<Item>();
    pair.exchange();
    EXPECT_TRUE(pair.source.commit().empty());
    { auto e = edit(item); }
    EXPECT_TRUE(pair.source.commit().empty());
    expectApplied(pair.replica.apply({}));
}

TEST(ChangeList, ManyEditsOfAFieldCollapseIntoOne) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    pair.exchange();
    edit(item)->number = 1;
    const auto once = pair.source.commit().bytes.size();
    EXPECT_EQ(once, headerBytes + changeBytes + 4);
    for (int i = 2; i < 1000; ++i) edit(item)->number = i;
    const auto list = pair.source.commit();
    EXPECT_EQ(list.bytes.size(), once);
    expectApplied(pair.replica.apply(list));
    EXPECT_EQ(pair.replica.get(Ref<Item>{item.id()})->number, 999);
}

TEST(ChangeList, AMultiFieldsRangeTravelsAlone) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    edit(item)->numbers.assign(std::vector<std::int32_t>(100'000, 5));
    pair.exchange();
    {
        auto e = edit(item);
        e->numbers.set(5000, 1);
        e->numbers.set(5009, 2);
    }
    const auto list = pair.exchange();
    EXPECT_EQ(list.bytes.size(), headerBytes + changeBytes + 12 + 10 * 4);
    pair.expectEqual();

    edit(item)->numbers.pushBack(6);
    EXPECT_EQ(pair.exchange().bytes.size(), headerBytes + changeBytes + 12 + 4);
    edit(item)->numbers.erase(100'000);
    EXPECT_EQ(pair.exchange().bytes.size(), headerBytes + changeBytes + 12);
    pair.expectEqual();
}

TEST(ChangeList, CreationsThenChangesThenReleases) {
    Pair pair;
    const Item& old = pair.source.create<Item>();
    const Item& kept = pair.source.create<Item>();
    const Id oldId = old.id();
    pair.exchange();
    // Done in the other order, and mixed.
    expectApplied(pair.source.destroy(old));
    edit(kept)->number = 4;
    const Item& made = pair.source.create<Item>();
    edit(kept)->next = made;
    const Item& brief = pair.source.create<Item>();
    expectApplied(pair.source.destroy(brief));

    const auto list = pair.source.commit();
    Reader from{list.bytes};
    EXPECT_EQ(from.scalar<std::uint8_t>(), ChangeList::version);
    EXPECT_EQ(from.scalar<std::uint32_t>(), 1U);
    EXPECT_EQ(from.scalar<std::uint32_t>(), 2U);
    EXPECT_EQ(from.scalar<std::uint32_t>(), 1U);
    EXPECT_EQ(from.scalar<TypeId>(), typeIdOf("Item"));
    EXPECT_EQ(from.id(), made.id());
    Reader last{std::span{list.bytes}.last(8)};
    EXPECT_EQ(last.id(), oldId);

    Applied applied;
    expectApplied(pair.replica.apply(list, &applied));
    EXPECT_EQ(applied.created, std::vector{made.id()});
    EXPECT_EQ(applied.destroyed, std::vector{oldId});
    pair.expectEqual();
}

TEST(ChangeList, IsLittleEndian) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    pair.exchange();
    edit(item)->number = 0x01020304;
    const auto list = pair.source.commit();
    const std::vector<unsigned> expected{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0,  // header
                                         1, 0, 0, 0, 0, 0, 1, 0,                 // counter, space
                                         4, 0, 0, 0,                             // mask
                                         4, 3, 2, 1};
    std::vector<unsigned> found;
    for (const std::byte b : list.bytes) found.push_back(static_cast<unsigned>(b));
    EXPECT_EQ(found, expected);
}

TEST(ChangeList, ListsJoinInOrder) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    edit(a)->data = payloadOf("first");
    ChangeList all = pair.source.commit();
    edit(a)->data = payloadOf("second");
    const Item& b = pair.source.create<Item>();
    edit(b)->next = a;
    all.append(pair.source.commit());
    edit(b)->next = Ref<Item>{};
    expectApplied(pair.source.destroy(a));
    all.append(pair.source.commit());
    expectApplied(pair.replica.apply(all));
    pair.expectEqual();
}

TEST(ChangeList, FeedsSeveralAspects) {
    Pair pair;
    Aspect other{pair.types, 0};
    const Item& item = pair.source.create<Item>();
    edit(item)->words.assign({"one", "", "three"});
    expectApplied(other.apply(pair.exchange()));
    EXPECT_EQ(other.digest(), pair.source.digest());
}

TEST(ChangeList, ASnapshotMakesAnEqualAspect) {
    Pair pair;
    std::vector<const Item*> items;
    for (int i = 0; i < 50; ++i) {
        const Item& item = pair.source.create<Item>();
        auto e = edit(item);
        e->number = i;
        e->name = std::string(static_cast<std::size_t>(i), 'x');
        e->data = payloadOf("blob " + std::to_string(i % 7));
        if (!items.empty()) e->next = *items[static_cast<std::size_t>(i) / 2];
        items.push_back(&item);
    }
    pair.exchange();
    Aspect joiner{pair.types, 0};
    expectApplied(joiner.apply(pair.source.snapshot()));
    EXPECT_EQ(joiner.digest(), pair.source.digest());
    // It then follows like everyone else.
    edit(*items[3])->number = -3;
    expectApplied(pair.source.destroy(*items[49]));
    expectApplied(joiner.apply(pair.source.commit()));
    EXPECT_EQ(joiner.digest(), pair.source.digest());
    // A replica's snapshot is as good.
    Aspect second{pair.types, 0};
    expectApplied(second.apply(joiner.snapshot()));
    EXPECT_EQ(second.digest(), pair.source.digest());
}

// What compares equal is not the same: whoever joins later would keep the other zero.
TEST(ChangeList, ZerosKeepTheirSign) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    edit(item)->number = 7;
    pair.exchange();
    edit(item)->weight = -0.0;  // from 1.5
    pair.exchange();
    edit(item)->weight = 0.0;  // equal: not sent, and not written here
    EXPECT_TRUE(pair.exchange().empty());
    pair.expectEqual();

    // 0.0 before, here and there; then another value, then the other zero.
    Aspect first{pair.types, 0};
    expectApplied(first.apply(pair.source.snapshot()));
    EXPECT_EQ(first.digest(), pair.source.digest());
    const auto* copy = first.get(Ref<Item>{item.id()});
    ASSERT_NE(copy, nullptr);
    EXPECT_TRUE(std::signbit(copy->weight.get()));
    edit(item)->weight = 1.0;
    edit(item)->weight = 0.0;
    const auto list = pair.source.commit();
    expectApplied(first.apply(list));  // holds -0.0
    EXPECT_FALSE(std::signbit(copy->weight.get()));
    EXPECT_EQ(first.digest(), pair.source.digest());
}

TEST(ChangeList, WhatCameAndWentLeavesNothing) {
    Pair pair;
    const auto comeAndGo = [&](int times) {
        for (int i = 0; i < times; ++i) {
            const Item& item = pair.source.create<Item>();
            edit(item)->data = payloadOf(std::to_string(i));
            pair.exchange();
            expectApplied(pair.source.destroy(item));
            pair.exchange();
        }
    };
    edit(pair.source.create<Item>())->data = payloadOf("stays");
    comeAndGo(500);  // buffers have their size
    const auto before = mallinfo2().uordblks;
    comeAndGo(5000);
    // 16 bytes a payload, 8 a container and side would be 160 kB. A sanitizer's heap tells nothing.
    EXPECT_LT(mallinfo2().uordblks, before + 20'000);
    EXPECT_EQ(pair.source.digest(), pair.replica.digest());
}

TEST(ChangeList, DigestsAreIncrementalAndNameWhatDrifted) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    pair.exchange();
    pair.expectEqual();
    const auto before = pair.source.digest();
    edit(b)->number = 1;
    EXPECT_NE(pair.source.digest(), before);
    const auto ours = pair.source.digests(), theirs = pair.replica.digests();
    ASSERT_EQ(ours.size(), 2U);
    ASSERT_EQ(theirs.size(), 2U);
    EXPECT_EQ(ours[0].id, a.id());
    EXPECT_EQ(ours[0], theirs[0]);
    EXPECT_EQ(ours[1].id, b.id());
    EXPECT_NE(ours[1].digest, theirs[1].digest);
    edit(b)->number = 0;
    EXPECT_EQ(pair.source.digest(), before);
}

}  // namespace
}  // namespace gnomon::field::test
