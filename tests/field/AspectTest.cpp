// Creation, destruction, references and ids.
#include <set>

#include "TestTypes.h"

namespace gnomon::field::test {
namespace {

TEST(Aspect, IdsAreOfItsSpaceAndNeverUsedAgain) {
    Pair pair;
    std::set<Id> seen;
    for (int i = 0; i < 100; ++i) {
        const Item& item = pair.source.create<Item>();
        const Id id = item.id();
        EXPECT_EQ(id.space(), 1);
        EXPECT_TRUE(seen.insert(id).second);
        if (i % 2 == 0) expectApplied(pair.source.destroy(item));
        if (i % 7 == 0) pair.exchange();
        EXPECT_EQ(pair.source.find(id) == nullptr, i % 2 == 0);
    }
    pair.exchange();
    pair.expectEqual();
}

TEST(Aspect, WhatIsReferencedIsNotDestroyed) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    edit(a)->next = b;
    edit(a)->links.assign({Ref<Item>{b}, Ref<Item>{b}});
    EXPECT_EQ(b.references(), 3U);
    const auto refused = pair.source.destroy(b);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, Errc::edit);
    EXPECT_NE(refused.error().what.find("Item 1:2"), std::string::npos) << refused.error().what;
    EXPECT_FALSE(pair.source.destroyTree(b).has_value());
    edit(a)->next = Ref<Item>{};
    edit(a)->links.clear();
    EXPECT_EQ(b.references(), 0U);
    expectApplied(pair.source.destroy(b));
    EXPECT_EQ(pair.source.size(), 1U);
}

TEST(Aspect, GetKnowsTheType) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    const Note& note = pair.source.create<Note>();
    EXPECT_EQ(pair.source.get(Ref<Item>{item.id()}), &item);
    EXPECT_EQ(pair.source.get(Ref<Note>{item.id()}), nullptr);
    EXPECT_EQ(pair.source.get(Ref<Note>{note.id()}), &note);
    EXPECT_EQ(pair.source.get(Ref<FieldContainer>{item.id()}), &item);
    EXPECT_EQ(pair.source.get(Ref<Item>{}), nullptr);
}

TEST(Aspect, DestroyTreeTakesWhatOnlyItKept) {
    Pair pair;
    const Item& root = pair.source.create<Item>();
    const Item& own = pair.source.create<Item>();
    const Item& deep = pair.source.create<Item>();
    const Item& shared = pair.source.create<Item>();
    const Item& other = pair.source.create<Item>();
    edit(root)->links.assign({Ref<Item>{own}, Ref<Item>{shared}});
    edit(own)->next = deep;
    edit(other)->next = shared;
    pair.exchange();
    const Id sharedId = shared.id();
    expectApplied(pair.source.destroyTree(root));
    EXPECT_EQ(pair.source.size(), 2U);
    EXPECT_NE(pair.source.find(sharedId), nullptr);
    EXPECT_EQ(shared.references(), 1U);
    Applied applied;
    pair.exchange(&applied);
    EXPECT_EQ(applied.destroyed.size(), 3U);
    pair.expectEqual();
}

TEST(Aspect, WhatReferredToEachOtherCanGoTogether) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    edit(a)->next = b;
    edit(b)->next = a;
    pair.exchange();
    // The replica still has both references when the releases arrive.
    edit(a)->next = Ref<Item>{};
    expectApplied(pair.source.destroy(b));
    expectApplied(pair.source.destroy(a));
    pair.exchange();
    EXPECT_EQ(pair.replica.size(), 0U);
    pair.expectEqual();
}

TEST(Aspect, AContainerThatReferredGoesAfterWhatItReferredTo) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    edit(a)->next = b;
    pair.exchange();
    edit(a)->next = Ref<Item>{};
    expectApplied(pair.source.destroy(b));
    expectApplied(pair.source.destroy(a));
    pair.exchange();
    pair.expectEqual();
}

TEST(Aspect, TypesThatAreNotReplicatedStay) {
    Pair pair;
    const Note& note = pair.source.create<Note>();
    edit(note)->text = "here";
    const auto before = pair.source.digest();
    edit(note)->text = "still here";
    EXPECT_EQ(pair.source.digest(), before);
    EXPECT_TRUE(pair.source.commit().empty());
    EXPECT_TRUE(pair.source.digests().empty());
    pair.source.create<Item>();
    const auto list = pair.source.snapshot();
    Aspect joiner{pair.types, 0};
    expectApplied(joiner.apply(list));
    EXPECT_EQ(joiner.size(), 1U);

    Aspect importer{pair.types, 0, true};
    edit(importer.create<Note>())->text = "for the importer's reader";
    EXPECT_FALSE(importer.commit().empty());
}

TEST(Aspect, AdoptMovesIdsAndMakesThemItsOwn) {
    Pair pair;
    pair.source.create<Item>();
    pair.exchange();

    Aspect importer{pair.types, 0, true};
    const Item& a = importer.create<Item>();
    const Item& b = importer.create<Item>();
    edit(a)->next = b;
    edit(a)->data = payloadOf("mesh");
    const Id imported = a.id();
    const auto offset = pair.source.adopt(importer.commit());
    ASSERT_TRUE(offset.has_value()) << offset.error().text();

    const Item* adopted = pair.source.get(Ref<Item>{Id{imported.value + *offset}});
    ASSERT_NE(adopted, nullptr);
    EXPECT_EQ(adopted->id().space(), 1);
    ASSERT_NE(pair.source.get(adopted->next.get()), nullptr);
    edit(*adopted)->number = 5;  // writable here
    const Item& later = pair.source.create<Item>();
    EXPECT_GT(later.id().counter(), adopted->id().counter());
    pair.exchange();
    EXPECT_EQ(pair.replica.size(), 4U);
    pair.expectEqual();
    EXPECT_EQ(pair.replica.get(Ref<Item>{adopted->id()})->data->size(), 4U);
}

TEST(Aspect, AnAdoptedListCannotReachWhatWasHereBefore) {
    Pair pair;
    const Item& mine = pair.source.create<Item>();
    edit(mine)->number = 1;
    // Ids that the offset would wrap around to the one that is here.
    const std::uint64_t offset = Id::make(1, mine.id().counter()).value;
    const Id wrapped{mine.id().value - offset};
    for (const Id id : {wrapped, Id{mine.id().value - offset + (std::uint64_t{1} << 63U)},
                        Id{~0ULL}, Id{Reader::maxMoved + 1}, Id{0 - std::uint64_t{1}}}) {
        const auto created =
            pair.source.adopt(ListBuilder{}.header(1, 0, 0).creation<Item>(id).list());
        EXPECT_FALSE(created.has_value());
        const auto changed = pair.source.adopt(ListBuilder{}
                                                   .header(0, 1, 0)
                                                   .change(id, maskOf<Item>("number"))
                                                   .scalar(std::int32_t{9})
                                                   .list());
        EXPECT_FALSE(changed.has_value());
        EXPECT_FALSE(pair.source.adopt(ListBuilder{}.header(0, 0, 1).id(id).list()).has_value());
    }
    EXPECT_EQ(mine.number, 1);
    EXPECT_EQ(pair.source.size(), 1U);
    pair.source.create<Item>();  // ids were not used up
}

TEST(Aspect, OthersDoNotWriteItsContainers) {
    Pair pair;
    const Item& mine = pair.source.create<Item>();
    const auto changed = pair.source.apply(ListBuilder{}
                                               .header(0, 1, 0)
                                               .change(mine.id(), maskOf<Item>("number"))
                                               .scalar(std::int32_t{9})
                                               .list());
    ASSERT_FALSE(changed.has_value());
    EXPECT_EQ(changed.error().code, Errc::protocol);
    EXPECT_FALSE(pair.source.apply(ListBuilder{}.header(0, 0, 1).id(mine.id()).list()).has_value());
    EXPECT_FALSE(
        pair.source.apply(ListBuilder{}.header(1, 0, 0).creation<Item>(Id::make(1, 99)).list())
            .has_value());
    EXPECT_EQ(mine.number, 0);
    EXPECT_EQ(pair.source.size(), 1U);
}

TEST(Aspect, TwoWritersFollowEachOther) {
    const TypeRegistry types = itemTypes();
    Aspect first{types, 1};
    Aspect second{types, 2};
    const Item& a = first.create<Item>();
    expectApplied(second.apply(first.commit()));
    const Item& b = second.create<Item>();
    edit(b)->next = Ref<Item>{a.id()};
    expectApplied(first.apply(second.commit()));
    EXPECT_EQ(first.digest(), second.digest());
    EXPECT_FALSE(first.destroy(a).has_value()) << "the other's reference counts";
    EXPECT_TRUE(first.commit().empty()) << "what was applied is not committed again";
}

TEST(AspectDeathTest, AReferenceToNothingIsABugOfOurs) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    EXPECT_DEATH(edit(item)->next = Ref<Item>{Id::make(1, 77)}, "does not exist");
}

}  // namespace
}  // namespace gnomon::field::test
