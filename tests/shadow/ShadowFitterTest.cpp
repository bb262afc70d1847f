// One ShadowState per light and screen, as the session keeps them while an application edits.
#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/Types.h>
#include <gnomon/shadow_fit/ShadowFitter.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::shadow_fit {
namespace {

using namespace scene;

field::TypeRegistry sceneTypes() {
    field::TypeRegistry types;
    addTypes(types);
    return types;
}

/// An application's aspect, the session's, and a server's: a wall of two tiles in stereo.
class ShadowFitterTest : public testing::Test {
protected:
    ShadowFitterTest() {
        edit(root)->addChild(sun.node);
        const auto box = makeNode<Geometry>(app, "box");
        {
            auto e = edit(box.core);
            const math::vec3 low{-2.0F, 0.0F, -6.0F};
            const math::vec3 high{2.0F, 2.0F, -2.0F};
            e->chunks.assign({Chunk{.indexCount = 3, .min = low, .max = high}});
            e->boundsMin = low;
            e->boundsMax = high;
        }
        edit(sun.node)->addChild(box.node);
        edit(sun.core)->beacon = beacon.node;
        aim({1.0, -2.0, -0.5});
        {
            auto e = edit(screen);
            e->lowerLeft = math::dvec3{-2.0, 0.0, -1.0};
            e->lowerRight = math::dvec3{2.0, 0.0, -1.0};
            e->upperLeft = math::dvec3{-2.0, 2.0, -1.0};
        }
        edit(user)->roomFromHead = math::Affine{.translation = {0.0, 1.2, 1.0}};
        for (const Eye eye : {Eye::left, Eye::right})
            for (int column = 0; column < 2; ++column) addTile(eye, column);
    }

    void aim(const math::dvec3& direction) {
        const math::dmat4 look = math::lookAt({0.0, 0.0, 0.0}, direction, {0.0, 1.0, 0.0});
        edit(beacon.core)->matrix = math::toAffine(glm::inverse(look));
    }
    void addTile(Eye eye, int column) {
        const auto& decorator = app.create<ScreenDecorator>();
        {
            auto e = edit(decorator);
            e->decoratee = lens;
            e->screen = screen;
            e->user = user;
            e->eye = eye;
        }
        const auto& tile = app.create<TileDecorator>();
        {
            auto e = edit(tile);
            e->decoratee = decorator;
            e->part = math::Rect{.left = column * 0.5, .width = 0.5};
        }
        const auto& viewport = app.create<ShadowViewport>();
        {
            auto e = edit(viewport);
            e->camera = tile;
            e->root = root;
            e->technique = "std";
        }
        const auto& window = app.create<Window>();
        edit(window)->viewports.assign({Ref<Viewport>{viewport}});
        viewports.push_back(&viewport);
        windows.push_back(&window);
    }
    /// A frame: the application's changes to everybody, then the fits to the server.
    field::ChangeList frame() {
        const auto list = app.commit();
        field::Applied applied;
        expectApplied(session.apply(list, &applied));
        expectApplied(server.apply(list));
        fitter.update(session, applied);
        auto fits = session.commit();
        expectApplied(server.apply(fits));
        EXPECT_EQ(session.digest(), server.digest());
        return fits;
    }
    static void expectApplied(const Result<void>& result) {
        EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().text());
    }
    std::vector<const ShadowState*> states() const {
        std::vector<const ShadowState*> found;
        server.forEach([&](const field::FieldContainer& c) {
            if (const auto* state = dynamic_cast<const ShadowState*>(&c)) found.push_back(state);
        });
        return found;
    }
    const ShadowState& onlyState() const {
        const auto found = states();
        EXPECT_EQ(found.size(), 1U);
        static const ShadowState none;
        return found.size() == 1 ? *found[0] : none;
    }

    field::TypeRegistry types = sceneTypes();
    field::Aspect app{types, 1};
    field::Aspect session{types, 2};
    field::Aspect server{types, 0};
    std::vector<std::string> warnings;
    ShadowFitter fitter{[this](std::string text) { warnings.push_back(std::move(text)); }};

    const Node& root = app.create<Node>();
    const NodeWith<DirectionalLight> sun = makeNode<DirectionalLight>(app, "sun");
    const NodeWith<Transform> beacon = makeNode<Transform>(app, "beacon");
    const Screen& screen = app.create<Screen>();
    const User& user = app.create<User>();
    const PerspectiveCamera& lens = app.create<PerspectiveCamera>();
    std::vector<const ShadowViewport*> viewports;
    std::vector<const Window*> windows;
};

TEST_F(ShadowFitterTest, AllTilesAndBothEyesOfAScreenShareOneState) {
    frame();
    const ShadowState& state = onlyState();
    EXPECT_EQ(state.light->id, sun.node.id());
    EXPECT_EQ(state.group->id, screen.id());
    EXPECT_EQ(state.filter.get(), "hard");
    EXPECT_FALSE(state.degenerate);
    ASSERT_EQ(state.clipFromWorld.size(), 1U);

    // Fitted to both eyes' whole views, as one does by hand.
    std::vector<math::View> views;
    for (const std::size_t i : {0U, 2U}) {
        const auto view = cameraView(session, viewports[i]->camera, 1.0);
        ASSERT_TRUE(view.has_value());
        views.push_back(view->whole);
    }
    FlatScene flat{session};
    flat.update(Ref<Node>{root.id()}, {}, {});
    const auto standard = std::find_if(fits().begin(), fits().end(),
                                       [](const FitInfo& i) { return i.name == "std"; });
    const LightShape light = lightShape(flat.lights()[0]);
    math::BoxTree boxes;
    boxes.build({flat.bounds()});
    Receivers receivers;
    for (const math::View& view : views) receivers.add(view, &light, boxes);
    const auto expected = standard->fit({.light = light,
                                         .views = views,
                                         .receivers = receivers,
                                         .scene = flat.bounds(),
                                         .mapSize = 512});
    ASSERT_EQ(expected.maps.size(), 1U);
    const math::dmat4& found = state.clipFromWorld[0];
    EXPECT_EQ(found, expected.maps[0].clipFromWorld);
    // What the first tile sees does not choose: without it the state is the same.
    const math::dmat4 before = found;
    edit(*windows[0])->viewports.clear();
    frame();
    EXPECT_EQ(onlyState().clipFromWorld[0], before);
}

TEST_F(ShadowFitterTest, NothingIsEditedWhenNothingChanged) {
    EXPECT_FALSE(frame().empty());
    EXPECT_TRUE(frame().empty());
    edit(*windows[0])->title = "no fit depends on this";
    EXPECT_TRUE(frame().empty());
}

TEST_F(ShadowFitterTest, AMovedLightChangesItsMapsAlone) {
    frame();
    const field::Id id = onlyState().id();
    const math::dmat4 before = onlyState().clipFromWorld[0];
    aim({-1.0, -2.0, 0.5});
    const auto list = app.commit();
    field::Applied applied;
    expectApplied(session.apply(list, &applied));
    fitter.update(session, applied);
    applied.clear();
    expectApplied(server.apply(list));
    expectApplied(server.apply(session.commit(), &applied));
    ASSERT_EQ(applied.changed.size(), 1U);
    EXPECT_EQ(applied.changed[0].mask,
              field::maskOf<ShadowState>("clipFromWorld") | field::maskOf<ShadowState>("source"));
    EXPECT_EQ(onlyState().id(), id);
    EXPECT_NE(onlyState().clipFromWorld[0], before);
}

TEST_F(ShadowFitterTest, ALightThatIsDestroyedTakesItsStateAlong) {
    frame();
    ASSERT_EQ(states().size(), 1U);
    // All in one frame: the scene is taken down while a state speaks of its light.
    edit(root)->removeChild(sun.node);
    const auto gone = app.destroyTree(sun.node);
    ASSERT_TRUE(gone.has_value()) << gone.error().text();
    frame();
    EXPECT_TRUE(states().empty());
}

TEST_F(ShadowFitterTest, AScreenThatIsDestroyedTakesItsStatesAlong) {
    frame();
    const field::Id screenId = screen.id();
    for (const Window* window : windows) {
        edit(*window)->viewports.clear();
        ASSERT_TRUE(app.destroy(*window).has_value());
    }
    for (const ShadowViewport* viewport : viewports) ASSERT_TRUE(app.destroyTree(*viewport));
    EXPECT_EQ(app.find(screenId), nullptr) << "nothing else kept it";
    frame();
    EXPECT_TRUE(states().empty());
}

TEST_F(ShadowFitterTest, StatesGoWithWhatAskedForThem) {
    frame();
    edit(sun.core)->on = false;
    frame();
    EXPECT_TRUE(states().empty());
    edit(sun.core)->on = true;
    frame();
    EXPECT_EQ(states().size(), 1U);
    edit(sun.core)->castsShadow = false;
    frame();
    EXPECT_TRUE(states().empty());
    edit(sun.core)->castsShadow = true;
    for (const ShadowViewport* viewport : viewports) edit(*viewport)->shadowOn = false;
    frame();
    EXPECT_TRUE(states().empty());
    for (const ShadowViewport* viewport : viewports) edit(*viewport)->shadowOn = true;
    frame();
    EXPECT_EQ(states().size(), 1U);
    for (const ShadowViewport* viewport : viewports) edit(*viewport)->technique = "none";
    frame();
    EXPECT_TRUE(states().empty());
}

TEST_F(ShadowFitterTest, MapsAreWholePages) {
    struct Case {
        int asked, map, page;
    };
    for (const Case& c : {Case{512, 512, 512}, Case{2048, 2048, 1024}, Case{1500, 2048, 1024},
                          Case{100, 100, 100}, Case{3, 16, 16}, Case{1 << 20, 16384, 1024}}) {
        for (const ShadowViewport* viewport : viewports) edit(*viewport)->mapSize = c.asked;
        frame();
        EXPECT_EQ(onlyState().mapSize, c.map) << c.asked;
        EXPECT_EQ(onlyState().pageSize, c.page) << c.asked;
    }
}

TEST_F(ShadowFitterTest, AMapWhoseSizeIsNotSaidIsAsFineAsTheScreen) {
    struct Case {
        glm::ivec2 tile;  // two of them side by side are the screen
        int map;
    };
    for (const Case& c : {Case{{100, 100}, 512}, Case{{960, 1080}, 2048}, Case{{1024, 1024}, 1024},
                          Case{{1024, 1025}, 2048}, Case{{40000, 60000}, 16384}}) {
        for (const Window* window : windows) edit(*window)->size = c.tile;
        frame();
        EXPECT_EQ(onlyState().mapSize, c.map) << c.tile.x << "x" << c.tile.y;
    }
}

TEST_F(ShadowFitterTest, ExactDepthIsWaitedForAndHolds) {
    frame();
    const math::dmat4 without = onlyState().clipFromWorld[0];
    for (const ShadowViewport* viewport : viewports) edit(*viewport)->depthRange = DepthUse::exact;
    frame();
    EXPECT_TRUE(fitter.wantsDepth());
    EXPECT_EQ(onlyState().clipFromWorld[0], without) << "as it was, until the depth is known";
    // The box is 3 to 7 m in front of the eyes: only its front is seen.
    fitter.fit(session, DepthSpan{.near = 3.0, .far = 3.5});
    EXPECT_FALSE(fitter.wantsDepth());
    expectApplied(server.apply(session.commit()));
    const math::dmat4 within = onlyState().clipFromWorld[0];
    EXPECT_GT(glm::determinant(math::dmat3{within}), glm::determinant(math::dmat3{without}) * 1.2);
    EXPECT_TRUE(frame().bytes.empty() || !fitter.wantsDepth()) << "a still scene needs no depth";
    // Nothing seen at all.
    aim({1.0, -2.0, -0.6});
    frame();
    ASSERT_TRUE(fitter.wantsDepth());
    fitter.fit(session, std::nullopt);
    expectApplied(server.apply(session.commit()));
    EXPECT_TRUE(onlyState().clipFromWorld.empty());
}

TEST_F(ShadowFitterTest, TheLastFramesDepthHoldsWithAMargin) {
    for (const ShadowViewport* viewport : viewports)
        edit(*viewport)->depthRange = DepthUse::previous;
    frame();
    EXPECT_FALSE(fitter.wantsDepth());
    EXPECT_TRUE(fitter.tellsDepth());
    const math::dmat4 without = onlyState().clipFromWorld[0];
    fitter.depthSeen(DepthSpan{.near = 3.0, .far = 3.5});
    frame();  // without any change
    const math::dmat4 within = onlyState().clipFromWorld[0];
    EXPECT_NE(within, without);
    fitter.depthSeen(DepthSpan{.near = 2.9, .far = 3.7});
    frame();
    EXPECT_EQ(onlyState().clipFromWorld[0], within) << "within the margin";
    fitter.depthSeen(DepthSpan{.near = 2.9, .far = 5.0});
    frame();
    EXPECT_NE(onlyState().clipFromWorld[0], within);
}

TEST_F(ShadowFitterTest, APointLightIsASpotThatSeesTheScene) {
    const auto lamp = makeNode<PointLight>(app, "lamp");
    edit(sun.node)->addChild(lamp.node);
    const auto place = makeNode<Transform>(app, "place");
    edit(root)->addChild(place.node);
    edit(lamp.core)->beacon = place.node;
    edit(sun.core)->on = false;
    edit(place.core)->matrix = math::Affine{.translation = {0.0, 8.0, -4.0}};
    frame();
    // All that is seen of the box, 6 m below.
    ASSERT_EQ(onlyState().clipFromWorld.size(), 1U);
    for (const double x : {-0.9, 0.9}) {
        const math::dvec4 clip = onlyState().clipFromWorld[0] * math::dvec4{x, 1.9, -2.1, 1.0};
        EXPECT_GT(clip.w, 0.0);
        EXPECT_LE(std::abs(clip.x), clip.w * 1.001);
        EXPECT_LE(std::abs(clip.y), clip.w * 1.001);
    }
    EXPECT_TRUE(warnings.empty());
    edit(place.core)->matrix = math::Affine{.translation = {0.0, 1.0, -4.0}};  // within the box
    frame();
    EXPECT_EQ(warnings.size(), 1U);
    for (const math::dmat4& map : onlyState().clipFromWorld) EXPECT_TRUE(math::isFinite(map));
}

TEST_F(ShadowFitterTest, WhatCannotBeDoneIsToldOnce) {
    for (const ShadowViewport* viewport : viewports) edit(*viewport)->technique = "nonsense";
    frame();
    aim({0.1, -1.0, 0.0});
    frame();
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("\"nonsense\""), std::string::npos) << warnings[0];
    EXPECT_TRUE(states().empty());
}

TEST_F(ShadowFitterTest, APlaceThatIsNotFiniteIsMarkedAndHasNoMaps) {
    edit(beacon.core)->matrix =
        math::Affine{.translation = math::dvec3{std::nan("")}, .linear = math::mat3{std::nanf("")}};
    frame();
    for (const ShadowState* state : states())
        for (const math::dmat4& map : state->clipFromWorld) EXPECT_TRUE(math::isFinite(map));
}

TEST_F(ShadowFitterTest, ChosenLightsAlone) {
    const auto second = makeNode<SpotLight>(app, "lamp");
    edit(sun.node)->addChild(second.node);
    edit(second.core)->beacon = beacon.node;
    frame();
    EXPECT_EQ(states().size(), 2U);
    for (const ShadowViewport* viewport : viewports)
        edit(*viewport)->lightNodes.assign({Ref<Node>{second.node}});
    frame();
    EXPECT_EQ(onlyState().light->id, second.node.id());
}

TEST_F(ShadowFitterTest, SoManyLightsWithLargeMapsShareThePagesThereAre) {
    for (int i = 1; i < 40; ++i) {
        const auto more = makeNode<DirectionalLight>(app, "sun");
        edit(sun.node)->addChild(more.node);
        edit(more.core)->beacon = beacon.node;
        // Above what they light.
        edit(more.node)->addChild(makeNode<Group>(app, "none").node);
    }
    for (const FitInfo& info : fits()) {
        for (const ShadowViewport* viewport : viewports) {
            auto e = edit(*viewport);
            e->technique = std::string{info.name};
            e->mapSize = 16384;
            e->cascades = 8;
        }
        frame();
        std::size_t maps = 0;
        std::size_t pages = 0;
        for (const ShadowState* state : states()) {
            const auto side = static_cast<std::size_t>(state->mapSize / state->pageSize);
            maps += state->clipFromWorld.size();
            pages += state->clipFromWorld.size() * side * side;
            EXPECT_GE(state->mapSize.get(), 256);
        }
        EXPECT_EQ(states().size(), 40U);
        EXPECT_LE(maps, static_cast<std::size_t>(mostMaps)) << info.name;
        EXPECT_LE(pages, static_cast<std::size_t>(mostPages)) << info.name;
    }
}

}  // namespace
}  // namespace gnomon::shadow_fit
