// Trees that no honest application sends.
#include <algorithm>
#include <initializer_list>

#include "SceneFixture.h"

namespace gnomon::scene {
namespace {

using field::ChangeList;
using field::Id;
using field::Writer;

Id idOf(std::uint64_t counter) { return Id::make(1, counter); }

struct Children {
    std::uint64_t parent = 0;
    std::vector<std::uint64_t> children = {};
};

/// A block: nodes 1..count are created where asked, then each line sets one node's whole list; then
/// some are released.
ChangeList treeOf(std::uint64_t count, const std::vector<Children>& lines,
                  const std::vector<std::uint64_t>& released = {}) {
    Writer to;
    to.scalar(ChangeList::version);
    to.scalar(static_cast<std::uint32_t>(count));
    to.scalar(static_cast<std::uint32_t>(lines.size()));
    to.scalar(static_cast<std::uint32_t>(released.size()));
    for (std::uint64_t i = 1; i <= count; ++i) {
        to.scalar(field::typeIdOf(Node::typeName));
        to.id(idOf(i));
    }
    for (const Children& line : lines) {
        const auto size = static_cast<std::uint32_t>(line.children.size());
        to.id(idOf(line.parent));
        to.scalar(field::maskOf<Node>("children"));
        to.scalar(size);
        to.scalar(0U);
        to.scalar(size);
        for (const auto child : line.children) to.id(idOf(child));
    }
    for (const auto node : released) to.id(idOf(node));
    return {.bytes = to.take()};
}

void expectRefused(std::initializer_list<ChangeList> lists, std::string_view why) {
    const auto types = sceneTypes();
    field::Aspect aspect{types, 0};
    std::size_t at = 0;
    for (const ChangeList& list : lists) {
        const auto result = aspect.apply(list);
        if (++at < lists.size()) {
            ASSERT_TRUE(result.has_value()) << result.error().text();
            continue;
        }
        ASSERT_FALSE(result.has_value()) << why;
        EXPECT_EQ(result.error().code, Errc::protocol);
        EXPECT_NE(result.error().what.find(why), std::string::npos) << result.error().what;
    }
}

TEST(HostileScene, TwoParentsAreRefused) {
    expectRefused({treeOf(3, {{1, {3}}, {2, {3}}})}, "two parents");
    expectRefused({treeOf(3, {{1, {3}}, {2, {3}}, {1, {3}}})}, "two parents");
}

TEST(HostileScene, ASecondParentInALaterListIsRefused) {
    expectRefused({treeOf(3, {{1, {3}}}), treeOf(0, {{2, {3}}})}, "two parents");
    expectRefused({treeOf(4, {{1, {3, 4}}}), treeOf(0, {{2, {4}}})}, "two parents");
}

// With two of these, a cycle could be made that no way up from a node leads round.
TEST(HostileScene, AParentThatTakesAChildAndLetsItGoCannotHideAnother) {
    const auto tree = treeOf(5, {{1, {2}}, {2, {3}}});
    expectRefused({tree, treeOf(0, {{4, {2}}, {5, {2}}, {4, {}}})}, "two parents");
    expectRefused({tree, treeOf(0, {{4, {2}}, {4, {}}})}, "two parents");
    expectRefused({tree, treeOf(0, {{4, {2}}}, {4})}, "two parents");
}

TEST(HostileScene, ManySmallChangesOfALargeNodeAreAsQuickAsTheyAreSmall) {
    // With a look at all children for each change this takes minutes.
    constexpr std::uint64_t count = 30'000;
    Children all{.parent = 1};
    for (std::uint64_t i = 2; i <= count; ++i) all.children.push_back(i);
    const auto types = sceneTypes();
    field::Aspect aspect{types, 0};
    ASSERT_TRUE(aspect.apply(treeOf(count, {all})).has_value());
    Writer to;
    constexpr std::uint32_t changes = 30'000;
    for (std::uint32_t i = 0; i < changes; ++i) {
        to.scalar(ChangeList::version);
        for (const std::uint32_t n : {0U, 1U, 0U}) to.scalar(n);
        to.id(idOf(1));
        to.scalar(field::maskOf<Node>("children"));
        for (const auto n : {count - 1, std::uint64_t{i % 100}, std::uint64_t{0}})
            to.scalar(static_cast<std::uint32_t>(n));
    }
    ASSERT_TRUE(aspect.apply({.bytes = to.take()}).has_value());
    EXPECT_EQ(aspect.get(Ref<Node>{idOf(count)})->parent().id, idOf(1));
}

TEST(HostileScene, TheSameChildTwiceIsRefused) {
    // A doubling at each level would be a tree of 2^1024 uses.
    expectRefused({treeOf(2, {{1, {2, 2}}})}, "twice");
    expectRefused({treeOf(3, {{1, {2}}}), treeOf(0, {{1, {2, 3, 2}}})}, "twice");
}

TEST(HostileScene, CyclesAreRefused) {
    expectRefused({treeOf(1, {{1, {1}}})}, "above itself");
    expectRefused({treeOf(2, {{1, {2}}, {2, {1}}})}, "above itself");
    expectRefused({treeOf(3, {{1, {2}}, {2, {3}}}), treeOf(0, {{3, {1}}})}, "above itself");
    expectRefused({treeOf(4, {{1, {2}}, {2, {1}}, {3, {4}}})}, "above itself");
}

TEST(HostileScene, TreesDeeperThanTheLimitAreRefused) {
    std::vector<Children> chain;
    for (std::uint64_t i = 1; i < 1100; ++i) chain.push_back({i, {i + 1}});
    expectRefused({treeOf(1100, chain)}, "deeper than 1024 levels");
    chain.resize(1000);
    const auto types = sceneTypes();
    field::Aspect aspect{types, 0};
    EXPECT_TRUE(aspect.apply(treeOf(1100, chain)).has_value());
}

TEST(HostileScene, AChildThatIsNoNodeIsRefused) {
    Writer to;
    to.scalar(ChangeList::version);
    to.scalar(2U);
    to.scalar(1U);
    to.scalar(0U);
    to.scalar(field::typeIdOf(Node::typeName));
    to.id(idOf(1));
    to.scalar(field::typeIdOf(Group::typeName));
    to.id(idOf(2));
    to.id(idOf(1));
    to.scalar(field::maskOf<Node>("children"));
    for (const std::uint32_t n : {1U, 0U, 1U}) to.scalar(n);
    to.id(idOf(2));
    expectRefused({ChangeList{.bytes = to.take()}}, "no node");
}

TEST(HostileScene, HonestMovesPassInAnyOrder) {
    const auto types = sceneTypes();
    for (const bool takenFirst : {true, false}) {
        field::Aspect aspect{types, 0};
        ASSERT_TRUE(aspect.apply(treeOf(4, {{1, {3, 4}}})).has_value());
        std::vector<Children> move{{1, {4}}, {2, {3}}};
        if (!takenFirst) std::swap(move[0], move[1]);
        const auto moved = aspect.apply(treeOf(0, move));
        ASSERT_TRUE(moved.has_value()) << moved.error().text();
        const Node* child = aspect.get(Ref<Node>{idOf(3)});
        EXPECT_EQ(child->parent().id, idOf(2));
        // And back, with others reordered.
        EXPECT_TRUE(aspect.apply(treeOf(0, {{2, {}}, {1, {4, 3}}})).has_value());
        EXPECT_EQ(child->parent().id, idOf(1));
    }
}

}  // namespace
}  // namespace gnomon::scene
