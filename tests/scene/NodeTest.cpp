// The tree: parents, children, and what may not be.
#include "SceneFixture.h"

namespace gnomon::scene {
namespace {

class NodeTest : public SceneTest {
protected:
    static void expectRefused(const Node& parent, const Node& child,
                              const std::vector<std::string>& words) {
        const std::size_t before = parent.children().size();
        try {
            edit(parent)->addChild(child);
            FAIL() << "a cycle was made";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.error().code, Errc::edit);
            for (const auto& word : words)
                EXPECT_NE(failure.error().what.find(word), std::string::npos) << failure.what();
        }
        EXPECT_EQ(parent.children().size(), before);
    }
};

TEST_F(NodeTest, ChildrenKnowTheirParentInEveryAspect) {
    const Node& top = node("top");
    const Node& a = node("a");
    const Node& b = node("b");
    edit(top)->addChild(a);
    edit(a)->addChild(b);
    EXPECT_EQ(b.parent(), Ref<Node>{a});
    exchange();
    EXPECT_EQ(copyOf(b)->parent(), Ref<Node>{a});
    EXPECT_EQ(copyOf(a)->parent(), Ref<Node>{top});
    EXPECT_FALSE(copyOf(top)->parent());
}

TEST_F(NodeTest, AddingTakesTheChildFromItsOldParent) {
    const Node& from = node("from");
    const Node& to = node("to");
    const Node& child = node("child");
    edit(from)->addChild(child);
    exchange();
    edit(to)->addChild(child);
    EXPECT_TRUE(from.children().empty());
    EXPECT_EQ(child.parent(), Ref<Node>{to});
    exchange();
    EXPECT_TRUE(copyOf(from)->children().empty());
    EXPECT_EQ(copyOf(child)->parent(), Ref<Node>{to});
    EXPECT_EQ(source.digest(), replica.digest());
    edit(to)->removeChild(child);
    exchange();
    EXPECT_FALSE(copyOf(child)->parent());
    EXPECT_THROW(edit(to)->removeChild(child), Failure);
}

TEST_F(NodeTest, AChildIsMovedFromAParentThatGoes) {
    const Node& from = node("from");
    const Node& to = node("to");
    const Node& child = node("child");
    edit(from)->addChild(child);
    exchange();
    edit(to)->addChild(child);
    ASSERT_TRUE(source.destroy(from).has_value());
    exchange();
    EXPECT_EQ(copyOf(child)->parent(), Ref<Node>{to});
    EXPECT_EQ(source.digest(), replica.digest());
    edit(to)->name = "still sound";
    exchange();
}

TEST_F(NodeTest, ACycleIsRefusedNamingBothNodes) {
    const Node& top = node("top");
    const Node& middle = node("middle");
    const Node& leaf = node("leaf");
    edit(top)->addChild(middle);
    edit(middle)->addChild(leaf);
    expectRefused(leaf, top, {"\"leaf\"", "\"top\"", "1:1", "1:3"});
    expectRefused(leaf, middle, {"\"leaf\"", "\"middle\""});
    expectRefused(leaf, leaf, {"\"leaf\""});
    exchange();
    EXPECT_EQ(source.digest(), replica.digest());
}

TEST_F(NodeTest, ATreeIsNotDeeperThanItsLimit) {
    const Node* at = &node("0");
    for (int depth = 1; depth < Node::maxDepth + 5; ++depth) {
        const Node& next = node(std::to_string(depth));
        if (depth > Node::maxDepth) {
            expectRefused(*at, next, {"deeper than 1024 levels"});
            break;
        }
        try {
            edit(*at)->addChild(next);
        } catch (const Failure& failure) {
            EXPECT_GE(depth, Node::maxDepth) << failure.what();
            break;
        }
        at = &next;
    }
    exchange();
    EXPECT_EQ(source.digest(), replica.digest());
}

TEST_F(NodeTest, DestroyingATreeFreesItsParts) {
    const auto made = makeNode<Transform>(source, "moved");
    const Node& leaf = node("leaf");
    edit(leaf)->core = unitBox();
    edit(made.node)->addChild(leaf);
    exchange();
    ASSERT_TRUE(source.destroyTree(made.node).has_value());
    exchange();
    EXPECT_EQ(source.size(), 0U);
    EXPECT_EQ(replica.size(), 0U);
}

TEST_F(NodeTest, WorldFromNodeComposesTransforms) {
    const auto outer = makeNode<Transform>(source, "outer");
    const auto inner = makeNode<Transform>(source, "inner");
    const Node& leaf = node("leaf");
    edit(outer.node)->addChild(inner.node);
    edit(inner.node)->addChild(leaf);
    edit(outer.core)->matrix =
        math::Affine{.translation = {1.0, 2.0, 3.0}, .linear = math::mat3{2.0F}};
    edit(inner.core)->matrix = math::Affine{.translation = {10.0, 0.0, 0.0}};
    const math::dmat4 world = worldFromNode(source, leaf);
    EXPECT_EQ(math::dvec3{world[3]}, math::dvec3(21.0, 2.0, 3.0));
    EXPECT_EQ(worldFromNode(source, {}), math::dmat4{1.0});
}

}  // namespace
}  // namespace gnomon::scene
