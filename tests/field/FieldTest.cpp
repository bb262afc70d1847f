// Fields, edit scopes and what can be said of a container from its table.
#include <type_traits>

#include "TestTypes.h"

namespace gnomon::field::test {
namespace {

// Containers are seen const, so what would be a forgotten begin-edit does not compile.
template <class Container, class Member>
using Seen = decltype((std::declval<const Container&>().*std::declval<Member>()));
static_assert(!std::is_assignable_v<Seen<Item, Field<std::int32_t> Item::*>, std::int32_t>);
static_assert(!std::is_assignable_v<Seen<Item, Field<std::string> Item::*>, std::string>);
static_assert(
    !std::is_assignable_v<Seen<Item, MultiField<std::int32_t> Item::*>, MultiField<std::int32_t>>);
template <class M>
concept Writable = requires(M multi) {
    multi.set(0, 1);
}
|| requires(M multi) { multi.pushBack(1); }
|| requires(M multi) { multi.clear(); };
static_assert(!Writable<const MultiField<std::int32_t>&>);
static_assert(Writable<MultiField<std::int32_t>&>);
// Inside a scope it does, and what the aspect hands out is const.
static_assert(std::is_assignable_v<decltype((std::declval<Item&>().number)), std::int32_t>);
static_assert(std::is_same_v<decltype(std::declval<Aspect&>().create<Item>()), const Item&>);
static_assert(
    std::is_same_v<decltype(std::declval<const Aspect&>().get(Ref<Item>{})), const Item*>);
static_assert(!std::is_copy_constructible_v<Item>);

static_assert(maskOf<Item>("on") == 1U);
static_assert(maskOf<Item>("number") == 4U);
static_assert(maskOf<Item>("no such field") == 0U);
static_assert(minimumBytes("dddfffffffff") == 60);
static_assert(minimumBytes("p") == 24 && minimumBytes("s") == 4 && minimumBytes("r") == 8);

TEST(Field, HasItsDefaultAndTakesAValueInAnEditScope) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    EXPECT_EQ(item.weight, 1.5);
    EXPECT_EQ(item.level, 3);
    EXPECT_FALSE(item.on);
    {
        auto e = edit(item);
        e->number = 7;
        e->name = "seven";
        e->numbers.assign({1, 2, 3});
    }
    EXPECT_EQ(item.number, 7);
    EXPECT_EQ(item.name.get(), "seven");
    EXPECT_EQ(item.name->size(), 5U);
    ASSERT_EQ(item.numbers.size(), 3U);
    EXPECT_EQ(item.numbers[1], 2);
}

TEST(Field, AnEditMarksJustWhatItWrote) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    pair.exchange();
    edit(item)->number = 7;
    {
        auto e = edit(item);
        e->on = true;
    }
    Applied applied;
    pair.exchange(&applied);
    ASSERT_EQ(applied.changed.size(), 1U);
    EXPECT_EQ(applied.changed[0].id, item.id());
    EXPECT_EQ(applied.changed[0].mask, maskOf<Item>("number") | maskOf<Item>("on"));
    EXPECT_TRUE(applied.created.empty());
}

TEST(Field, WritingAnEqualValueMarksNothing) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    {
        auto e = edit(item);
        e->numbers.assign({1, 2});
        e->data = payloadOf("bulk");
    }
    pair.exchange();
    {
        auto e = edit(item);
        e->weight = 1.5;
        e->numbers.assign({1, 2});
        e->numbers.set(1, 2);
        e->data = payloadOf("bulk");
    }
    EXPECT_TRUE(pair.source.commit().empty());
}

TEST(Field, EditScopesNest) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    pair.exchange();
    {
        auto outer = edit(a);
        outer->number = 1;
        {
            auto inner = edit(a);
            inner->name = "inner";
            edit(b)->number = 2;
        }
        outer->on = true;
    }
    Applied applied;
    pair.exchange(&applied);
    ASSERT_EQ(applied.changed.size(), 2U);
    pair.expectEqual();
    const Item* copy = pair.replica.get(Ref<Item>{a.id()});
    ASSERT_NE(copy, nullptr);
    EXPECT_TRUE(sameFields(a, *copy));
    EXPECT_EQ(copy->number, 1);
    EXPECT_EQ(copy->name.get(), "inner");
    EXPECT_TRUE(copy->on);
}

TEST(Field, OneWriterPerContainer) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    pair.exchange();
    const Item* copy = pair.replica.get(Ref<Item>{item.id()});
    ASSERT_NE(copy, nullptr);
    try {
        edit(*copy)->number = 1;
        FAIL() << "an aspect wrote what is another's";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().code, Errc::edit);
        EXPECT_NE(failure.error().what.find("Item 1:1"), std::string::npos) << failure.what();
    }
    EXPECT_EQ(copy->number, 0);
}

TEST(Field, EqualityAndPrintingComeFromTheTable) {
    Pair pair;
    const Item& a = pair.source.create<Item>();
    const Item& b = pair.source.create<Item>();
    EXPECT_TRUE(sameFields(a, b));
    edit(b)->numbers.pushBack(42);
    EXPECT_FALSE(sameFields(a, b));
    edit(a)->numbers.pushBack(42);
    EXPECT_TRUE(sameFields(a, b));
    edit(a)->name = "clock";
    const std::string text = print(a);
    EXPECT_NE(text.find("Item 1:1"), std::string::npos) << text;
    EXPECT_NE(text.find("weight = 1.5"), std::string::npos) << text;
    EXPECT_NE(text.find("clock"), std::string::npos) << text;
    EXPECT_NE(text.find("42"), std::string::npos) << text;
    EXPECT_FALSE(sameFields(a, pair.source.create<Note>()));
}

TEST(Field, MultiFieldOperationsDoWhatAVectorDoes) {
    Pair pair;
    const Item& item = pair.source.create<Item>();
    std::vector<std::int32_t> model;
    std::mt19937 random{3};
    for (int round = 0; round < 500; ++round) {
        {
            auto e = edit(item);
            const auto value = static_cast<std::int32_t>(random());
            const std::size_t at = model.empty() ? 0 : random() % model.size();
            switch (random() % 6) {
                case 0:
                    e->numbers.pushBack(value);
                    model.push_back(value);
                    break;
                case 1:
                    e->numbers.insert(at, value);
                    model.insert(model.begin() + static_cast<std::ptrdiff_t>(at), value);
                    break;
                case 2:
                    if (model.empty()) break;
                    e->numbers.erase(at);
                    model.erase(model.begin() + static_cast<std::ptrdiff_t>(at));
                    break;
                case 3:
                    if (model.empty()) break;
                    e->numbers.set(at, value);
                    model[at] = value;
                    break;
                case 4:
                    if (random() % 20 != 0) break;
                    e->numbers.clear();
                    model.clear();
                    break;
                default:
                    e->numbers.pushBack(value);
                    model.push_back(value);
                    break;
            }
        }
        ASSERT_TRUE(
            std::equal(model.begin(), model.end(), item.numbers.begin(), item.numbers.end()));
        if (random() % 3 != 0) continue;  // several edits a commit
        pair.exchange();
        const auto& copy = pair.replica.get(Ref<Item>{item.id()})->numbers;
        ASSERT_TRUE(std::equal(model.begin(), model.end(), copy.begin(), copy.end())) << round;
    }
    pair.exchange();
    pair.expectEqual();
}

}  // namespace
}  // namespace gnomon::field::test
