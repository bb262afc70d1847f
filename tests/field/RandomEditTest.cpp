// Whatever is edited, whoever follows by change lists ends up equal.
#include "Editor.h"

namespace gnomon::field::test {
namespace {

class RandomEdits : public testing::TestWithParam<unsigned> {};

TEST_P(RandomEdits, FollowersStayEqual) {
    Pair pair;
    Editor editor{pair.source, GetParam()};
    Aspect late{pair.types, 0};
    ChangeList held;
    for (int round = 0; round < 200; ++round) {
        editor.steps(1 + round % 17);
        held.append(pair.exchange());
        ASSERT_EQ(pair.source.digest(), pair.replica.digest()) << "round " << round;
        if (round % 31 == 0) {
            // One who applies many lists at once.
            expectApplied(late.apply(held));
            held = {};
            ASSERT_EQ(late.digest(), pair.source.digest()) << "round " << round;
        }
        if (round % 50 == 0) {
            Aspect joiner{pair.types, 0};
            expectApplied(joiner.apply(pair.replica.snapshot()));
            ASSERT_EQ(joiner.digest(), pair.source.digest());
        }
    }
    // Counts agree too, not only values.
    pair.source.forEach([&](const FieldContainer& container) {
        const FieldContainer* copy = pair.replica.find(container.id());
        ASSERT_NE(copy, nullptr);
        EXPECT_EQ(container.references(), copy->references());
        EXPECT_TRUE(sameFields(container, *copy));
    });
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEdits, testing::Range(0U, 20U));

}  // namespace
}  // namespace gnomon::field::test
