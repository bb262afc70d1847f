// The flattened scene: what follows incrementally equals what is built anew.
#include <algorithm>
#include <random>

#include "SceneFixture.h"

namespace gnomon::scene {
namespace {

class FlatSceneTest : public SceneTest {
protected:
    void expectEqual(const FlatScene& followed, const FlatScene& built) {
        const auto a = followed.instances();
        const auto b = built.instances();
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].node, b[i].node);
            EXPECT_EQ(a[i].geometry, b[i].geometry);
            EXPECT_EQ(a[i].material, b[i].material);
            EXPECT_EQ(a[i].lights, b[i].lights);
            EXPECT_EQ(a[i].castsShadow, b[i].castsShadow);
            EXPECT_EQ(a[i].mirrored, b[i].mirrored);
            EXPECT_EQ(a[i].bounds, b[i].bounds);
            EXPECT_EQ(followed.worldFromLocal(a[i]), built.worldFromLocal(b[i]));
        }
        ASSERT_EQ(followed.lights().size(), built.lights().size());
        for (std::size_t i = 0; i < followed.lights().size(); ++i) {
            EXPECT_EQ(followed.lights()[i].node, built.lights()[i].node);
            EXPECT_EQ(followed.lights()[i].light, built.lights()[i].light);
            EXPECT_EQ(followed.lights()[i].worldFromBeacon, built.lights()[i].worldFromBeacon);
        }
        EXPECT_EQ(followed.bounds(), built.bounds());
        EXPECT_EQ(followed.lightsLeftOut(), built.lightsLeftOut());
    }
    FlatScene flatten(const Node& root) {
        exchange();
        FlatScene flat{replica};
        flat.update(Ref<Node>{root.id()}, {}, {});
        return flat;
    }
    const Node& boxNode(std::string name) {
        const Node& made = node(std::move(name));
        edit(made)->core = unitBox();
        return made;
    }
};

math::Affine moveBy(const math::dvec3& by) { return {.translation = by}; }

class RandomScenes : public FlatSceneTest, public testing::WithParamInterface<unsigned> {};

TEST_P(RandomScenes, FollowingEqualsBuildingAnew) {
    std::mt19937 random{GetParam()};
    const auto pick = [&](std::size_t below) { return random() % below; };
    std::vector<const Node*> nodes{&node("root")};
    std::vector<const Transform*> transforms;
    std::vector<const NodeCore*> cores;
    std::vector<const PhongMaterial*> materials;
    const Node& root = *nodes[0];
    const auto add = [&](const Node& made) {
        edit(*nodes[pick(nodes.size())])->addChild(made);
        nodes.push_back(&made);
    };
    const auto step = [&] {
        const double x = static_cast<double>(pick(2000)) * 0.01 - 10.0;
        switch (pick(16)) {
            case 0: {
                const auto made = makeNode<Transform>(source, "t");
                transforms.push_back(&made.core);
                add(made.node);
                break;
            }
            case 1: {
                const Node& made = boxNode("g");
                cores.push_back(source.get(made.core.get()));
                add(made);
                break;
            }
            case 2: {
                const auto made = makeNode<MaterialGroup>(source, "m");
                materials.push_back(&source.create<PhongMaterial>());
                edit(made.core)->material = *materials.back();
                add(made.node);
                break;
            }
            case 3: {
                const auto made = makeNode<SpotLight>(source, "l");
                if (pick(2) == 0) edit(made.core)->beacon = *nodes[pick(nodes.size())];
                add(made.node);
                break;
            }
            case 4: {  // a core that is used again
                if (cores.empty()) break;
                const Node& made = node("again");
                edit(made)->core = Ref<NodeCore>{*cores[pick(cores.size())]};
                add(made);
                break;
            }
            case 5: {
                const Node& made = *nodes[pick(nodes.size())];
                const Node& to = *nodes[pick(nodes.size())];
                if (&made == &root) break;
                try {
                    edit(to)->addChild(made);
                } catch (const Failure&) {  // it would have been a cycle
                }
                break;
            }
            case 6:
                if (materials.empty()) break;
                edit(*materials[pick(materials.size())])->shininess = static_cast<float>(pick(99));
                break;
            default: {
                if (transforms.empty()) break;
                math::Affine m = moveBy({x, x * 0.5, -x});
                if (pick(4) == 0) m.linear = math::mat3{-1.0F};
                edit(*transforms[pick(transforms.size())])->matrix = m;
                break;
            }
        }
    };
    for (int i = 0; i < 60; ++i) step();
    exchange();
    FlatScene followed{replica};
    followed.update(Ref<Node>{root.id()}, {}, {});
    int kept = 0;
    for (int round = 0; round < 120; ++round) {
        for (std::size_t i = 0; i <= pick(3); ++i) step();
        followed.update(Ref<Node>{root.id()}, {}, exchange());
        kept += followed.rebuilt() ? 0 : 1;
        FlatScene built{replica};
        built.update(Ref<Node>{root.id()}, {}, {});
        expectEqual(followed, built);
        ASSERT_FALSE(HasFailure()) << "round " << round;
    }
    EXPECT_GT(kept, 10) << "nothing was followed, all was built anew";
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::Range(0U, 12U));

TEST_F(FlatSceneTest, AMovedTransformTellsWhereThingsWereAndAre) {
    const auto moved = makeNode<Transform>(source, "moved");
    const Node& root = node("root");
    edit(root)->addChild(moved.node);
    edit(moved.node)->addChild(boxNode("box"));
    edit(root)->addChild(boxNode("still"));
    exchange();
    FlatScene flat{replica};
    flat.update(Ref<Node>{root.id()}, {}, {});
    EXPECT_TRUE(flat.rebuilt());
    flat.update(Ref<Node>{root.id()}, {}, {});
    EXPECT_FALSE(flat.rebuilt());
    EXPECT_TRUE(flat.moved().empty());

    edit(moved.core)->matrix = moveBy({5.0, 0.0, 0.0});
    flat.update(Ref<Node>{root.id()}, {}, exchange());
    EXPECT_FALSE(flat.rebuilt());
    ASSERT_EQ(flat.moved().size(), 1U);
    ASSERT_EQ(flat.movedBounds().size(), 1U);
    EXPECT_EQ(flat.movedBounds()[0],
              (math::Box{.min = math::dvec3{0.0}, .max = math::dvec3{6.0, 1.0, 1.0}}));
    EXPECT_EQ(flat.bounds(), (math::Box{.min = math::dvec3{0.0}, .max = {6.0, 1.0, 1.0}}));
}

TEST_F(FlatSceneTest, LightsLightWhatIsBelowThem) {
    const Node& root = node("root");
    const auto lamp = makeNode<PointLight>(source, "lamp");
    const auto sun = makeNode<DirectionalLight>(source, "sun");
    const Node& inside = boxNode("inside");
    const Node& outside = boxNode("outside");
    edit(root)->addChild(sun.node);
    edit(sun.node)->addChild(lamp.node);
    edit(lamp.node)->addChild(inside);
    edit(sun.node)->addChild(outside);
    const Node& dark = boxNode("dark");
    edit(root)->addChild(dark);
    const auto flat = flatten(root);
    ASSERT_EQ(flat.lights().size(), 2U);
    const auto lightsOf = [&](const Node& n) {
        for (const auto& instance : flat.instances())
            if (instance.node->id() == n.id()) {
                std::vector<std::string> names;
                for (std::size_t i = 0; i < flat.lights().size(); ++i)
                    if ((instance.lights >> i & 1U) != 0)
                        names.push_back(flat.lights()[i].node->name);
                return names;
            }
        return std::vector<std::string>{"not found"};
    };
    EXPECT_EQ(lightsOf(inside), (std::vector<std::string>{"sun", "lamp"}));
    EXPECT_EQ(lightsOf(outside), (std::vector<std::string>{"sun"}));
    EXPECT_TRUE(lightsOf(dark).empty());
}

TEST_F(FlatSceneTest, MoreLightsThanCanBeAreLeftOutAndCounted) {
    const Node* at = &node("root");
    const Node& root = *at;
    for (std::size_t i = 0; i < FlatScene::maxLights + 3; ++i) {
        const auto lamp = makeNode<PointLight>(source, "lamp");
        edit(*at)->addChild(lamp.node);
        at = &lamp.node;
    }
    edit(*at)->addChild(boxNode("box"));
    const auto flat = flatten(root);
    EXPECT_EQ(flat.lights().size(), FlatScene::maxLights);
    EXPECT_EQ(flat.lightsLeftOut(), 3U);
    EXPECT_EQ(flat.instances()[0].lights, ~std::uint64_t{0});
}

TEST_F(FlatSceneTest, ALightShinesFromItsBeacon) {
    const Node& root = node("root");
    const auto lamp = makeNode<SpotLight>(source, "lamp");
    const auto beacon = makeNode<Transform>(source, "beacon");
    edit(root)->addChild(lamp.node);
    edit(root)->addChild(beacon.node);
    edit(lamp.core)->beacon = beacon.node;
    edit(beacon.core)->matrix = moveBy({1.0, 2.0, 3.0});
    exchange();
    FlatScene flat{replica};
    flat.update(Ref<Node>{root.id()}, {}, {});
    EXPECT_EQ(math::dvec3{flat.lights()[0].worldFromBeacon[3]}, math::dvec3(1.0, 2.0, 3.0));
    edit(beacon.core)->matrix = moveBy({7.0, 0.0, 0.0});
    flat.update(Ref<Node>{root.id()}, {}, exchange());
    EXPECT_FALSE(flat.rebuilt());
    EXPECT_TRUE(flat.lightsChanged());
    EXPECT_EQ(math::dvec3{flat.lights()[0].worldFromBeacon[3]}, math::dvec3(7.0, 0.0, 0.0));
}

TEST_F(FlatSceneTest, ABeaconOutsideTheRootIsFollowedToo) {
    // As the client hangs lights to things that are not drawn.
    const Node& root = node("root");
    const auto lamp = makeNode<SpotLight>(source, "lamp");
    const auto beacon = makeNode<Transform>(source, "beacon");
    edit(root)->addChild(lamp.node);
    edit(lamp.core)->beacon = beacon.node;
    exchange();
    FlatScene flat{replica};
    flat.update(Ref<Node>{root.id()}, {}, {});
    edit(beacon.core)->matrix = moveBy({4.0, 0.0, 0.0});
    flat.update(Ref<Node>{root.id()}, {}, exchange());
    EXPECT_EQ(math::dvec3{flat.lights()[0].worldFromBeacon[3]}, math::dvec3(4.0, 0.0, 0.0));
}

TEST_F(FlatSceneTest, ASharedCoreIsUsedWhereverItHangs) {
    const Node& root = node("root");
    const Geometry& shared = unitBox();
    const auto moved = makeNode<Transform>(source, "moved");
    edit(root)->addChild(moved.node);
    const Node& a = node("a");
    const Node& b = node("b");
    edit(a)->core = shared;
    edit(b)->core = shared;
    edit(root)->addChild(a);
    edit(moved.node)->addChild(b);
    edit(moved.core)->matrix = moveBy({3.0, 0.0, 0.0});
    // The transform too: two nodes move with one core.
    const Node& twin = node("twin");
    edit(twin)->core = moved.core;
    const Node& c = node("c");
    edit(c)->core = shared;
    edit(root)->addChild(twin);
    edit(twin)->addChild(c);
    exchange();
    FlatScene flat{replica};
    flat.update(Ref<Node>{root.id()}, {}, {});
    ASSERT_EQ(flat.instances().size(), 3U);
    edit(moved.core)->matrix = moveBy({8.0, 0.0, 0.0});
    flat.update(Ref<Node>{root.id()}, {}, exchange());
    EXPECT_EQ(flat.moved().size(), 2U);
    for (const auto& instance : flat.instances())
        EXPECT_EQ(instance.bounds.min.x, instance.node->id() == a.id() ? 0.0 : 8.0);
}

TEST_F(FlatSceneTest, AMirroringIsSeen) {
    const auto moved = makeNode<Transform>(source, "moved");
    edit(moved.node)->addChild(boxNode("box"));
    exchange();
    FlatScene flat{replica};
    flat.update(Ref<Node>{moved.node.id()}, {}, {});
    EXPECT_FALSE(flat.instances()[0].mirrored);
    math::Affine mirror;
    mirror.linear[0][0] = -1.0F;
    edit(moved.core)->matrix = mirror;
    flat.update(Ref<Node>{moved.node.id()}, {}, exchange());
    EXPECT_TRUE(flat.instances()[0].mirrored);
    EXPECT_TRUE(flat.rebuilt()) << "whoever groups by winding must know";
}

TEST_F(FlatSceneTest, ExcludedSubtreesCastNoShadow) {
    const Node& root = node("root");
    const Node& group = node("group");
    edit(root)->addChild(group);
    edit(group)->addChild(boxNode("inside"));
    edit(root)->addChild(boxNode("outside"));
    exchange();
    FlatScene flat{replica};
    const std::vector<Ref<Node>> excluded{Ref<Node>{group.id()}};
    flat.update(Ref<Node>{root.id()}, excluded, {});
    ASSERT_EQ(flat.instances().size(), 2U);
    for (const auto& instance : flat.instances())
        EXPECT_EQ(instance.castsShadow, instance.node->name.get() == "outside");
    flat.update(Ref<Node>{root.id()}, {}, {});
    EXPECT_TRUE(flat.rebuilt());
    EXPECT_TRUE(flat.instances()[0].castsShadow && flat.instances()[1].castsShadow);
}

TEST_F(FlatSceneTest, ARootThatIsNotThereIsEmpty) {
    FlatScene flat{replica};
    flat.update(Ref<Node>{}, {}, {});
    EXPECT_TRUE(flat.instances().empty());
    EXPECT_TRUE(flat.bounds().empty());
    const Node& root = boxNode("root");
    exchange();
    flat.update(Ref<Node>{root.id()}, {}, {});
    EXPECT_EQ(flat.instances().size(), 1U);
    const Ref<Node> gone{root.id()};
    ASSERT_TRUE(source.destroyTree(root).has_value());
    flat.update(gone, {}, exchange());
    EXPECT_TRUE(flat.instances().empty());
}

}  // namespace
}  // namespace gnomon::scene
