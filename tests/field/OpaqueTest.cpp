// A process that does not know a type keeps, digests and forwards its containers.
#include "Editor.h"

namespace gnomon::field::test {
namespace {

TypeRegistry strangerTo(const TypeRegistry& types) {
    TypeRegistry stranger;
    expectApplied(stranger.agree(types.schema(), "the application"));
    return stranger;
}

class OpaqueEdits : public testing::TestWithParam<unsigned> {};

TEST_P(OpaqueEdits, AreKeptDigestedAndForwarded) {
    const TypeRegistry types = itemTypes();
    const TypeRegistry foreign = strangerTo(types);
    ASSERT_TRUE(foreign.find(typeIdOf("Item"))->opaque);
    EXPECT_EQ(foreign.schema(), types.schema());
    Aspect source{types, 1};
    Aspect stranger{foreign, 0};
    Editor editor{source, GetParam()};
    for (int round = 0; round < 60; ++round) {
        editor.steps(20);
        expectApplied(stranger.apply(source.commit()));
        ASSERT_EQ(stranger.digest(), source.digest()) << round;
        ASSERT_EQ(stranger.size(), source.size());
    }
    // What it passes on is understood by whoever knows the type.
    Aspect knowing{types, 0};
    expectApplied(knowing.apply(stranger.snapshot()));
    EXPECT_EQ(knowing.digest(), source.digest());
    source.forEach([&](const FieldContainer& container) {
        EXPECT_EQ(container.references(), stranger.find(container.id())->references());
        EXPECT_EQ(print(container), print(*stranger.find(container.id())));
    });
}

INSTANTIATE_TEST_SUITE_P(Seeds, OpaqueEdits, testing::Range(0U, 5U));

TEST(Opaque, AreNotTakenForTypesThatAreKnown) {
    const TypeRegistry types = itemTypes();
    const TypeRegistry foreign = strangerTo(types);
    Aspect source{types, 1};
    Aspect stranger{foreign, 0};
    const Item& item = source.create<Item>();
    expectApplied(stranger.apply(source.commit()));
    EXPECT_EQ(stranger.get(Ref<Item>{item.id()}), nullptr);
    EXPECT_NE(stranger.get(Ref<FieldContainer>{item.id()}), nullptr);
}

TEST(Opaque, PayloadsAreCounted) {
    const TypeRegistry types = itemTypes();
    const TypeRegistry foreign = strangerTo(types);
    Aspect source{types, 1};
    Aspect stranger{foreign, 0};
    stranger.followPayloads();
    const Item& item = source.create<Item>();
    edit(item)->blobs.assign({payloadOf("a"), payloadOf("b")});
    expectApplied(stranger.apply(source.commit()));
    edit(item)->blobs.erase(0);
    expectApplied(stranger.apply(source.commit()));
    EXPECT_EQ(stranger.takeUnusedPayloads(), std::vector{payloadOf("a").hash()});
    expectApplied(source.destroy(item));
    expectApplied(stranger.apply(source.commit()));
    EXPECT_EQ(stranger.takeUnusedPayloads(), std::vector{payloadOf("b").hash()});
}

TEST(Opaque, CorruptionIsRefusedOrUnderstood) {
    const TypeRegistry types = itemTypes();
    const TypeRegistry foreign = strangerTo(types);
    Aspect source{types, 1};
    Editor editor{source, 9};
    editor.steps(120);
    const ChangeList whole = source.commit();
    for (std::size_t length = 1; length < whole.bytes.size(); ++length) {
        ChangeList cut = whole;
        cut.bytes.resize(length);
        Aspect stranger{foreign, 0};
        ASSERT_FALSE(stranger.apply(cut).has_value()) << length;
    }
    for (unsigned seed = 0; seed < 2000; ++seed) {
        std::mt19937 random{seed};
        ChangeList broken = whole;
        for (int i = 0; i < 3; ++i)
            broken.bytes[random() % broken.bytes.size()] = static_cast<std::byte>(random());
        Aspect stranger{foreign, 0};
        if (!stranger.apply(broken)) continue;
        Aspect follower{foreign, 0};
        expectApplied(follower.apply(stranger.snapshot()));
        ASSERT_EQ(follower.digest(), stranger.digest()) << seed;
    }
}

}  // namespace
}  // namespace gnomon::field::test
