#include <gnomon/client/AnimationPlayer.h>
#include <gnomon/client/SceneSetup.h>
#include <gnomon/scene/CameraView.h>
#include <gtest/gtest.h>

#include <numbers>

#include "Imported.h"

namespace gnomon::client {
namespace {

using field::Ref;
using Path = scene::AnimationChannel::Path;

struct SceneTest : testing::Test {
    field::TypeRegistry types = test::sceneTypes();
    test::Importer importer{types};
    field::Aspect aspect{types, 2};

    bool isAbove(Ref<scene::Node> upper, Ref<scene::Node> lower) const {
        for (auto at = aspect.get(lower); at != nullptr; at = aspect.get(at->parent()))
            if (at->id() == upper.id) return true;
        return false;
    }
    math::dvec3 shinesAlong(Ref<scene::Node> node) const {
        const auto* light = aspect.get(Ref<scene::Light>{aspect.get(node)->core->id});
        return -math::dvec3{scene::worldFromNode(aspect, light->beacon)[2]};
    }
};

TEST_F(SceneTest, AddedLightsAreAboveTheModelAndPointWhereTheyShine) {
    auto tree = makeSceneTree(aspect);
    const auto model = adoptModel(aspect, tree, importer.take());
    ASSERT_TRUE(model) << model.error().what;
    const auto sun = addLight(aspect, tree, Sun{.toward = {3, 4, 0}, .angle = 0.25});
    const auto spot =
        addLight(aspect, tree, Spot{.position = {1, 2, 3}, .direction = {0, -2, 0}, .angle = 1.0});
    EXPECT_TRUE(isAbove(sun, model->root));
    EXPECT_TRUE(isAbove(spot, model->root));
    EXPECT_TRUE(isAbove(tree.root, sun));
    EXPECT_LT(glm::length(shinesAlong(sun) - math::dvec3{-0.6, -0.8, 0.0}), 1e-6);
    EXPECT_LT(glm::length(shinesAlong(spot) - math::dvec3{0.0, -1.0, 0.0}), 1e-6);
    const auto* cone = aspect.get(Ref<scene::SpotLight>{aspect.get(spot)->core->id});
    ASSERT_NE(cone, nullptr);
    EXPECT_FLOAT_EQ(cone->outerAngle, 0.5F);
    EXPECT_EQ(math::dvec3{scene::worldFromNode(aspect, cone->beacon)[3]}, (math::dvec3{1, 2, 3}));
}

TEST_F(SceneTest, AdoptedModelsKeepWhatTheImporterSaid) {
    importer.addLight();
    const auto tree = makeSceneTree(aspect);
    const auto model = adoptModel(aspect, tree, importer.take());
    ASSERT_TRUE(model);
    EXPECT_EQ(model->source, "made.glb");
    EXPECT_EQ(model->bounds.max, (math::dvec3{1.0, 3.0, 1.0}));
    EXPECT_EQ(aspect.get(model->root)->parent(), tree.content);
    ASSERT_EQ(model->lights.size(), 1U);
    EXPECT_TRUE(hasLight(aspect, *model));
    switchOffLights(aspect, *model);
    EXPECT_FALSE(hasLight(aspect, *model));
}

TEST_F(SceneTest, ABrokenListLeavesTheAspectAsItWas) {
    const auto tree = makeSceneTree(aspect);
    const auto before = aspect.size();
    auto list = importer.take();
    for (const std::size_t length : {list.bytes.size() / 3, list.bytes.size() - 1}) {
        auto cut = list;
        cut.bytes.resize(length);
        EXPECT_FALSE(adoptModel(aspect, tree, cut));
        EXPECT_EQ(aspect.size(), before);
    }
    field::Aspect empty{types, 0, true};
    scene::makeNode<scene::Group>(empty, "no scene");
    const auto none = adoptModel(aspect, tree, empty.commit());
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().what.find("exactly one scene"), std::string::npos);
    EXPECT_EQ(aspect.size(), before);
}

TEST_F(SceneTest, TwoModelsCanBeAdopted) {
    const auto tree = makeSceneTree(aspect);
    const auto first = adoptModel(aspect, tree, importer.take());
    test::Importer second{types};
    second.addLight();
    const auto other = adoptModel(aspect, tree, second.take());
    ASSERT_TRUE(first && other);
    EXPECT_NE(first->root, other->root);
    EXPECT_EQ(other->lights.size(), 1U);
    EXPECT_EQ(aspect.get(tree.content)->children().size(), 2U);
}

TEST_F(SceneTest, AnEmptySceneGetsTheDefaultSun) {
    const auto scene = prepareScene(aspect, {});
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->defaultSun);
    EXPECT_EQ(activeLights(aspect, *scene).size(), 1U);
    EXPECT_TRUE(scene->bounds.empty());
}

TEST_F(SceneTest, LightsOfTheCommandLineReplaceTheDefaultSun) {
    const auto scene = prepareScene(aspect, {.lights = {Sun{}, Point{.position = {0, 5, 0}}}});
    ASSERT_TRUE(scene);
    EXPECT_FALSE(scene->defaultSun);
    const auto lights = activeLights(aspect, *scene);
    ASSERT_EQ(lights.size(), 2U);
    EXPECT_NE(aspect.get(Ref<scene::DirectionalLight>{aspect.get(lights[0])->core->id}), nullptr);
    EXPECT_NE(aspect.get(Ref<scene::PointLight>{aspect.get(lights[1])->core->id}), nullptr);
}

TEST_F(SceneTest, TheModelsFirstCameraIsTheDefaultView) {
    const auto& mover = importer.addMover();
    math::dmat4 place = glm::inverse(math::lookAt({10, 2, 0}, {0, 2, 0}, {0, 1, 0}));
    edit(mover)->matrix = math::toAffine(place);
    const auto& camera = importer.aspect.create<scene::PerspectiveCamera>();
    {
        auto e = edit(camera);
        e->beacon = importer.root.children()[0];
        e->fovy = 0.5;
    }
    edit(importer.result)->cameras.pushBack(camera);
    PreparedScene scene;
    scene.tree = makeSceneTree(aspect);
    scene.model = adoptModel(aspect, scene.tree, importer.take()).value();
    scene.bounds = scene.model->bounds;
    const auto view = defaultView(aspect, scene, opening(1.0, 1.0), 2.0);
    EXPECT_EQ(view.fovy, 0.5);
    EXPECT_LT(glm::length(view.look.eye - math::dvec3{10, 2, 0}), 1e-6);
    const auto ahead = glm::normalize(view.look.center - view.look.eye);
    EXPECT_LT(glm::length(ahead - math::dvec3{-1, 0, 0}), 1e-6);
    // Seen from outside: its middle, 10 m away, comes to lie on the screen, 2 m away.
    EXPECT_NEAR(view.look.scale, 5.0, 1e-6);
}

TEST_F(SceneTest, AnimationsMoveOnlyWhatTheyMove) {
    const auto& mover = importer.addMover();
    importer.addMover();
    const auto& animation = importer.addAnimation(2.0F);
    importer.addChannel(animation, mover, Path::translation, {0.0F, 2.0F}, {0, 0, 0, 4, 0, 0});
    importer.addChannel(animation, mover, Path::rotation, {0.0F, 1.0F},
                        {0, 0, 0, 1, 0, 0.7071068F, 0, 0.7071068F});
    const auto& pose = importer.aspect.create<scene::AnimationPose>();
    {
        auto e = edit(pose);
        e->target = mover;
        e->scale = math::vec3{2.0F};
    }
    edit(importer.result)->poses.pushBack(pose);
    const auto tree = makeSceneTree(aspect);
    const auto model = adoptModel(aspect, tree, importer.take());
    ASSERT_TRUE(model);
    AnimationPlayer player;
    player.play(aspect, *model);
    aspect.commit();

    player.animate(aspect, 1.0);
    EXPECT_EQ(player.changed(), 1U);
    const auto& first = *aspect.get(aspect.get(model->root)->children()[0]);
    const auto matrix = aspect.get(Ref<scene::Transform>{first.core->id})->matrix.get();
    EXPECT_LT(glm::length(matrix.translation - math::dvec3{2, 0, 0}), 1e-6);
    // A quarter turn about y, twice as large: x goes to -2 z.
    EXPECT_LT(glm::length(matrix.linear[0] - math::vec3{0, 0, -2}), 1e-5F);
    EXPECT_LT(glm::length(matrix.linear[1] - math::vec3{0, 2, 0}), 1e-5F);
    EXPECT_FALSE(aspect.commit().empty());

    player.animate(aspect, 1.0);
    EXPECT_EQ(player.changed(), 0U);
    EXPECT_TRUE(aspect.commit().empty());
    player.animate(aspect, 3.0);  // once around
    EXPECT_EQ(player.changed(), 0U);
}

TEST_F(SceneTest, OfTwoAnimationsOfOnePropertyTheFirstPlays) {
    const auto& mover = importer.addMover();
    importer.addChannel(importer.addAnimation(1.0F), mover, Path::translation, {0.0F}, {1, 0, 0});
    importer.addChannel(importer.addAnimation(1.0F), mover, Path::translation, {0.0F}, {2, 0, 0});
    const auto tree = makeSceneTree(aspect);
    const auto model = adoptModel(aspect, tree, importer.take());
    AnimationPlayer player;
    player.play(aspect, *model);
    player.animate(aspect, 0.0);
    const auto& node = *aspect.get(aspect.get(model->root)->children()[0]);
    const auto matrix = aspect.get(Ref<scene::Transform>{node.core->id})->matrix.get();
    EXPECT_EQ(matrix.translation.x, 1.0);
}

}  // namespace
}  // namespace gnomon::client
