// Cameras with their decorators.
#include "SceneFixture.h"

namespace gnomon::scene {
namespace {

using math::dmat4;
using math::dvec2;
using math::dvec3;
using math::dvec4;

class CameraTest : public SceneTest {
protected:
    CameraView view(const Camera& camera, double aspect = 1.5) {
        auto result = cameraView(source, Ref<Camera>{camera}, aspect);
        EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().text());
        return result ? *result : CameraView{};
    }
    void expectNoView(const Camera& camera, std::string_view why) {
        const auto result = cameraView(source, Ref<Camera>{camera}, 1.0);
        ASSERT_FALSE(result.has_value());
        EXPECT_EQ(result.error().code, Errc::edit);
        EXPECT_NE(result.error().what.find(why), std::string::npos) << result.error().what;
    }
    static dvec2 seen(const math::View& v, const dvec3& world) {
        const dvec4 clip = v.clipFromWorld() * dvec4{world, 1.0};
        return dvec2{clip} / clip.w;
    }
    static void expectNear(const dvec2& a, const dvec2& b, double tolerance = 1e-9) {
        EXPECT_NEAR(a.x, b.x, tolerance);
        EXPECT_NEAR(a.y, b.y, tolerance);
    }
    const PerspectiveCamera& lens() {
        const auto beacon = makeNode<Transform>(source, "beacon");
        edit(beacon.core)->matrix = math::toAffine(
            glm::inverse(math::lookAt({3.0, 2.0, 7.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0})));
        const auto& camera = source.create<PerspectiveCamera>();
        auto e = edit(camera);
        e->beacon = beacon.node;
        e->fovy = 0.9;
        return camera;
    }
};

TEST_F(CameraTest, PerspectiveLooksAlongItsBeacon) {
    const auto result = view(lens());
    expectNear(seen(result.view, {0.0, 1.0, 0.0}), {0.0, 0.0}, 1e-6);
    EXPECT_NEAR(glm::length(result.view.eyeWorld() - dvec3(3.0, 2.0, 7.0)), 0.0, 1e-6);
    EXPECT_EQ(result.view.clipFromEye, math::perspective(0.9, 1.5, 0.1, 1000.0));
}

TEST_F(CameraTest, StereoEyesAgreeInTheZeroParallaxPlane) {
    const auto& inner = lens();
    const double zero = 2.5;
    std::array<CameraView, 3> eyes;
    for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) {
        const auto& camera = source.create<StereoDecorator>();
        {
            auto e = edit(camera);
            e->decoratee = inner;
            e->eye = eye;
            e->eyeSeparation = 0.07;
            e->zeroParallaxDistance = zero;
        }
        eyes[static_cast<std::size_t>(eye)] = view(camera);
    }
    const dmat4 worldFromMono = glm::inverse(eyes[0].view.eyeFromWorld);
    for (const dvec2& p : {dvec2{0.0, 0.0}, dvec2{0.7, -0.4}, dvec2{-1.1, 0.9}}) {
        const dvec3 onPlane{worldFromMono * dvec4{p, -zero, 1.0}};
        expectNear(seen(eyes[1].view, onPlane), seen(eyes[0].view, onPlane));
        expectNear(seen(eyes[2].view, onPlane), seen(eyes[0].view, onPlane));
        // Nearer, the right eye sees things further left than the left eye does.
        const dvec3 nearer{worldFromMono * dvec4{p * 0.4, -zero * 0.4, 1.0}};
        EXPECT_LT(seen(eyes[2].view, nearer).x, seen(eyes[1].view, nearer).x - 1e-3);
    }
    const dvec3 between = eyes[2].view.eyeWorld() - eyes[1].view.eyeWorld();
    EXPECT_NEAR(glm::length(between), 0.07, 1e-9);
    EXPECT_GT(glm::dot(between, dvec3{worldFromMono[0]}), 0.0);
    EXPECT_EQ(eyes[1].group, eyes[2].group) << "both eyes are of one fit group";
}

class ScreenTest : public CameraTest {
protected:
    ScreenTest() {
        auto e = edit(screen);
        e->lowerLeft = dvec3{-1.5, 0.5, -2.0};
        e->lowerRight = dvec3{1.5, 0.5, -2.0};
        e->upperLeft = dvec3{-1.5, 2.5, -2.0};
        edit(user)->roomFromHead = math::Affine{.translation = {0.2, 1.7, 0.3}};
    }
    const ScreenDecorator& decorator(Eye eye, const Navigation* navigation = nullptr) {
        const auto& camera = source.create<ScreenDecorator>();
        auto e = edit(camera);
        e->decoratee = inner;
        e->screen = screen;
        e->user = user;
        e->eye = eye;
        if (navigation != nullptr) e->navigation = *navigation;
        return camera;
    }

    const PerspectiveCamera& inner = lens();
    const Screen& screen = source.create<Screen>();
    const User& user = source.create<User>();
};

TEST_F(ScreenTest, IsTheOffAxisViewOfTheUsersEye) {
    for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) {
        const auto result = view(decorator(eye));
        const double shift = eye == Eye::left ? -0.0315 : eye == Eye::right ? 0.0315 : 0.0;
        EXPECT_NEAR(glm::length(result.view.eyeWorld() - dvec3(0.2 + shift, 1.7, 0.3)), 0.0, 1e-12);
        expectNear(seen(result.view, screen.lowerLeft), {-1.0, -1.0});
        expectNear(seen(result.view, screen.lowerRight), {1.0, -1.0});
        expectNear(seen(result.view, screen.upperLeft), {-1.0, 1.0});
        EXPECT_EQ(result.group.id, screen.id());
        EXPECT_EQ(result.worldScale, 1.0);
    }
}

TEST_F(ScreenTest, NavigationWithAScaleKeepsTheScreenAndNearAndFar) {
    const auto& navigation = source.create<Navigation>();
    // A room of a few metres over a city: a hundred times as large, turned and far away.
    const float c = 0.6F;
    const float s = 0.8F;
    const math::mat3 turn{c, 0.0F, -s, 0.0F, 1.0F, 0.0F, s, 0.0F, c};
    edit(navigation)->worldFromRoom =
        math::Affine{.translation = {5000.0, 30.0, -200.0}, .linear = 100.0F * turn};
    {
        auto e = edit(inner);
        e->near = 4.0;
        e->far = 8000.0;
    }
    const auto result = view(decorator(Eye::left, &navigation));
    const dmat4 worldFromRoom = math::toMatrix(navigation.worldFromRoom);
    const auto world = [&](const dvec3& room) { return dvec3{worldFromRoom * dvec4{room, 1.0}}; };
    expectNear(seen(result.view, world(screen.lowerLeft)), {-1.0, -1.0}, 1e-6);
    expectNear(seen(result.view, world(screen.lowerRight)), {1.0, -1.0}, 1e-6);
    expectNear(seen(result.view, world(screen.upperLeft)), {-1.0, 1.0}, 1e-6);
    EXPECT_NEAR(result.worldScale, 100.0, 1e-4);
    // eyeFromWorld is rigid, so that distances in eye space are metres of the world.
    EXPECT_NEAR(glm::determinant(math::dmat3{result.view.eyeFromWorld}), 1.0, 1e-6);
    EXPECT_NEAR(glm::length(result.view.eyeWorld() - world({0.2 - 0.0315, 1.7, 0.3})), 0.0, 1e-4);
    // Near and far are metres of the world along the screen's normal.
    const dvec3 ahead = glm::normalize(world({0.0, 0.0, -1.0}) - world({0.0, 0.0, 0.0}));
    const auto depth = [&](double d) {
        const dvec4 clip =
            result.view.clipFromWorld() * dvec4{result.view.eyeWorld() + ahead * d, 1.0};
        EXPECT_NEAR(clip.w, d, d * 1e-6) << "w is the distance";
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(4.0), 1.0, 1e-5);
    EXPECT_NEAR(depth(8000.0), 0.0, 1e-5);
}

TEST_F(ScreenTest, TilesShareTheirScreensWholeView) {
    const auto& whole = decorator(Eye::mono);
    const auto wholeView = view(whole);
    for (int x = 0; x < 2; ++x) {
        for (int y = 0; y < 2; ++y) {
            const auto& camera = source.create<TileDecorator>();
            const math::Rect part{.left = x * 0.5, .bottom = y * 0.5, .width = 0.5, .height = 0.5};
            {
                auto e = edit(camera);
                e->decoratee = whole;
                e->part = part;
            }
            const auto tile = view(camera);
            EXPECT_EQ(tile.whole.clipFromEye, wholeView.view.clipFromEye);
            EXPECT_EQ(tile.whole.eyeFromWorld, wholeView.view.eyeFromWorld);
            EXPECT_EQ(tile.group, wholeView.group);
            EXPECT_EQ(tile.part, part);
            const dvec3 p{0.1, 1.4, -3.0};
            const dvec2 share = (seen(wholeView.view, p) + 1.0) * 0.5;
            const dvec2 inTile = (seen(tile.view, p) + 1.0) * 0.5;
            expectNear(inTile, (share - dvec2{part.left, part.bottom}) / 0.5);
        }
    }
}

TEST_F(ScreenTest, ATileOfATileIsAPartOfTheWhole) {
    const auto& outer = source.create<TileDecorator>();
    const auto& tile = source.create<TileDecorator>();
    {
        auto e = edit(outer);
        e->decoratee = decorator(Eye::mono);
        e->part = math::Rect{.left = 0.5, .bottom = 0.0, .width = 0.5, .height = 0.5};
    }
    {
        auto e = edit(tile);
        e->decoratee = outer;
        e->part = math::Rect{.left = 0.5, .bottom = 0.5, .width = 0.5, .height = 0.5};
    }
    EXPECT_EQ(view(tile).part,
              (math::Rect{.left = 0.75, .bottom = 0.25, .width = 0.25, .height = 0.25}));
}

TEST_F(CameraTest, WhatCannotBeResolvedSaysWhy) {
    const auto& stereo = source.create<StereoDecorator>();
    expectNoView(stereo, "no camera");
    const auto& other = source.create<StereoDecorator>();
    edit(stereo)->decoratee = other;
    edit(other)->decoratee = stereo;
    expectNoView(stereo, "circle");
    const auto& screen = source.create<ScreenDecorator>();
    edit(screen)->decoratee = lens();
    expectNoView(screen, "without a screen");
    const auto& tile = source.create<TileDecorator>();
    {
        auto e = edit(tile);
        e->decoratee = lens();
        e->part = math::Rect{.width = 0.0};
    }
    expectNoView(tile, "without area");
}

}  // namespace
}  // namespace gnomon::scene
