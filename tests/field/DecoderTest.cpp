// Bytes that no honest aspect wrote.
#include <algorithm>
#include <cstdlib>
#include <new>

#include "Editor.h"

namespace gnomon::field::test {
namespace {

void expectRefused(const ChangeList& list, std::string_view why) {
    const TypeRegistry types = itemTypes();
    Aspect aspect{types, 0};
    const auto result = aspect.apply(list);
    ASSERT_FALSE(result.has_value()) << why;
    EXPECT_EQ(result.error().code, Errc::protocol);
    EXPECT_NE(result.error().what.find(why), std::string::npos) << result.error().what;
}

ChangeList richList() {
    Pair pair;
    Editor editor{pair.source, 5};
    editor.steps(150);
    ChangeList list = pair.source.commit();
    editor.steps(60);
    list.append(pair.source.commit());
    return list;
}

TEST(Decoder, EveryTruncationIsRefusedOrABlocksEnd) {
    const ChangeList whole = richList();
    Pair pair;
    Editor editor{pair.source, 5};
    editor.steps(150);
    const std::size_t blockEnd = pair.source.commit().bytes.size();
    ASSERT_LT(blockEnd, whole.bytes.size());
    for (std::size_t length = 0; length < whole.bytes.size(); ++length) {
        ChangeList cut = whole;
        cut.bytes.resize(length);
        const TypeRegistry types = itemTypes();
        Aspect aspect{types, 0};
        const bool complete = length == 0 || length == blockEnd;
        ASSERT_EQ(aspect.apply(cut).has_value(), complete) << length;
    }
}

TEST(Decoder, ExtraBytesAreRefused) {
    for (std::size_t extra = 1; extra < 20; ++extra) {
        ChangeList list = richList();
        list.bytes.resize(list.bytes.size() + extra);  // zeros: version 0
        expectRefused(list, "version 0, expected 1");
    }
    ChangeList list = richList();
    list.bytes.push_back(std::byte{ChangeList::version});  // the beginning of a block
    expectRefused(list, "cut short");
}

TEST(Decoder, AnotherVersionIsRefused) {
    for (const unsigned version : {0U, 2U, 255U}) {
        ChangeList list = richList();
        list.bytes[0] = static_cast<std::byte>(version);
        expectRefused(list, "version " + std::to_string(version) + ", expected 1");
    }
}

TEST(Decoder, NamesWhatIsWrong) {
    const Id id = Id::make(1, 1);
    const auto one = [&] { return ListBuilder{}.header(1, 1, 0).creation<Item>(id); };
    expectRefused(ListBuilder{}.header(1, 0, 0).scalar(TypeId{7}).id(id).list(), "unknown type 7");
    expectRefused(ListBuilder{}.header(1, 0, 0).creation<Item>(Id{}).list(), "id 0");
    expectRefused(ListBuilder{}.header(2, 0, 0).creation<Item>(id).creation<Item>(id).list(),
                  "container 1:1 is created twice");
    expectRefused(ListBuilder{}.header(0, 1, 0).change(id, 0).list(),
                  "container 1:1 does not exist");
    expectRefused(ListBuilder{}.header(0, 0, 1).id(id).list(), "container 1:1 does not exist");
    expectRefused(one().change(id, 1U << 12U).list(), "mask 4096 names fields it has not");
    expectRefused(one().change(id, maskOf<Item>("on")).scalar(std::uint8_t{2}).list(),
                  "(Item): a truth value");
    expectRefused(one().change(id, maskOf<Item>("colour")).scalar(3U).list(), "enumeration value");
    expectRefused(one().change(id, maskOf<Item>("next")).id(Id::make(1, 5)).list(),
                  "container 1:5, which does not exist");
    expectRefused(one()
                      .change(id, maskOf<Item>("data"))
                      .scalar(std::uint64_t{1})
                      .scalar(std::uint64_t{2})
                      .scalar(std::uint64_t{3})
                      .list(),
                  "a payload that has not arrived");
    expectRefused(one()
                      .change(id, maskOf<Item>("data"))
                      .scalar(std::uint64_t{1})
                      .scalar(std::uint64_t{2})
                      .scalar(std::uint64_t{0})
                      .list(),
                  "an empty payload with a hash");
    expectRefused(ListBuilder{}.header(1, 0, 2).creation<Item>(id).id(id).id(id).list(),
                  "container 1:1 does not exist");
    expectRefused(ListBuilder{}
                      .header(2, 1, 1)
                      .creation<Item>(id)
                      .creation<Item>(Id::make(1, 2))
                      .change(id, maskOf<Item>("next"))
                      .id(Id::make(1, 2))
                      .id(Id::make(1, 2))
                      .list(),
                  "container 1:2 is released but still referred to");
}

TEST(Decoder, RangesOfMultiFieldsMustFit) {
    const Id id = Id::make(1, 1);
    struct Range {
        std::uint32_t size, first, count;
    };
    for (const Range r :
         {Range{1, 1, 1}, Range{2, 1, 1}, Range{~0U, 0, 0}, Range{~0U, 0, 1}, Range{1, ~0U, 1},
          Range{~0U, ~0U, 0}, Range{~0U, 0, ~0U}, Range{0, 0, 1}, Range{5, 3, 2}}) {
        expectRefused(ListBuilder{}
                          .header(1, 1, 0)
                          .creation<Item>(id)
                          .change(id, maskOf<Item>("numbers"))
                          .scalar(r.size)
                          .scalar(r.first)
                          .scalar(r.count)
                          .scalar(std::int32_t{1})
                          .scalar(std::int32_t{1})
                          .list(),
                      "range does not fit");
    }
}

/// What this thread asked of the heap while it lives: the largest block, and all together.
class AllocationWatch {
public:
    AllocationWatch() { largest = total = 0; }
    static thread_local std::size_t largest, total;
};
thread_local std::size_t AllocationWatch::largest = 0;
thread_local std::size_t AllocationWatch::total = 0;

}  // namespace
}  // namespace gnomon::field::test

#if defined(__GNUC__) && !defined(__clang__)
// GCC inlines one of a pair and not the other, and then takes them for mismatched.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

// Counted, because "allocates no more than the bytes justify" is a claim about this.
void* operator new(std::size_t size) {
    auto& largest = gnomon::field::test::AllocationWatch::largest;
    largest = std::max(largest, size);
    gnomon::field::test::AllocationWatch::total += size;
    if (void* made = std::malloc(size)) return made;
    throw std::bad_alloc{};
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace gnomon::field::test {
namespace {

TEST(Decoder, AllocatesNoMoreThanTheBytesJustify) {
    const Id id = Id::make(1, 1);
    constexpr auto huge = ~std::uint32_t{0};
    std::vector<ChangeList> lists;
    lists.push_back(ListBuilder{}.header(huge, huge, huge).list());
    lists.push_back(ListBuilder{}.header(huge, 0, 0).creation<Item>(id).list());
    lists.push_back(ListBuilder{}.header(0, huge, 0).change(id, 0).list());
    lists.push_back(ListBuilder{}.header(0, 0, huge).id(id).list());
    lists.push_back(ListBuilder{}.header(1, huge, huge).creation<Item>(id).list());
    for (const char* field : {"numbers", "words", "links", "blobs"})
        for (const std::uint32_t count : {huge, 0x10000000U, 1000U})
            lists.push_back(ListBuilder{}
                                .header(1, 1, 0)
                                .creation<Item>(id)
                                .change(id, maskOf<Item>(field))
                                .scalar(count)
                                .scalar(0U)
                                .scalar(count)
                                .list());
    lists.push_back(ListBuilder{}
                        .header(1, 1, 0)
                        .creation<Item>(id)
                        .change(id, maskOf<Item>("name"))
                        .scalar(huge)
                        .list());
    const TypeRegistry types = itemTypes();
    for (const ChangeList& list : lists) {
        Aspect aspect{types, 0};
        const AllocationWatch watch;
        EXPECT_FALSE(aspect.apply(list).has_value());
        EXPECT_LT(watch.largest, 4096U) << "of " << list.bytes.size() << " bytes";
    }
    TypeRegistry other = itemTypes();
    Writer schema;
    schema.scalar(huge);
    schema.scalar(huge);
    const AllocationWatch watch;
    EXPECT_FALSE(other.agree(schema.written(), "a stranger").has_value());
    EXPECT_LT(watch.largest, 4096U);
}

TEST(Decoder, AContainerOfAStrangeTypeTakesNoRoomForWhatNobodyWrote) {
    constexpr std::uint32_t fields = 32;
    const std::string layout(64, 'd');
    Writer schema;
    schema.scalar(1U);
    schema.string("Strange");
    schema.scalar(fields);
    for (std::uint32_t i = 0; i < fields; ++i) {
        schema.string("f");
        schema.string(layout);
        schema.scalar(std::uint8_t{0});
    }
    TypeRegistry types;
    expectApplied(types.agree(schema.written(), "a stranger"));
    const auto list =
        ListBuilder{}.header(1, 0, 0).scalar(typeIdOf("Strange")).id(Id::make(1, 1)).list();
    Aspect aspect{types, 0};
    const AllocationWatch watch;
    expectApplied(aspect.apply(list));
    EXPECT_LT(watch.total, 4096U);
    // What nobody wrote is zero.
    const auto snapshot = aspect.snapshot();
    EXPECT_EQ(snapshot.bytes.size(), 13U + 12U + 12U + fields * 64U * 8U);
    EXPECT_TRUE(std::all_of(snapshot.bytes.begin() + 37, snapshot.bytes.end(),
                            [](std::byte b) { return b == std::byte{0}; }));
}

TEST(Decoder, RandomCorruptionIsRefusedOrUnderstood) {
    const ChangeList whole = richList();
    const TypeRegistry types = itemTypes();
    int refused = 0;
    for (unsigned seed = 0; seed < 10'000; ++seed) {
        std::mt19937 random{seed};
        ChangeList broken = whole;
        const int edits = 1 + static_cast<int>(random() % 4);
        for (int i = 0; i < edits; ++i) {
            const std::size_t at = random() % broken.bytes.size();
            switch (random() % 4) {
                case 0:
                    broken.bytes[at] = static_cast<std::byte>(random());
                    break;
                case 1:
                    broken.bytes[at] ^= static_cast<std::byte>(1U << random() % 8);
                    break;
                case 2:
                    broken.bytes.erase(broken.bytes.begin() + static_cast<std::ptrdiff_t>(at));
                    break;
                default:
                    broken.bytes.insert(broken.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                        static_cast<std::byte>(random()));
                    break;
            }
        }
        Aspect aspect{types, 0};
        const auto result = aspect.apply(broken);
        if (!result) {
            ++refused;
            ASSERT_EQ(result.error().code, Errc::protocol);
            continue;
        }
        // Understood: then it is a sound aspect, which another can follow.
        Aspect follower{types, 0};
        expectApplied(follower.apply(aspect.snapshot()));
        ASSERT_EQ(follower.digest(), aspect.digest()) << "seed " << seed;
    }
    EXPECT_GT(refused, 3000);
}

}  // namespace
}  // namespace gnomon::field::test
