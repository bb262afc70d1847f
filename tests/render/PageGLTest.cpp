// Pages of shadow maps: kept while nothing changes, drawn anew where something did.
#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::vec3;

class PageGLTest : public RenderTest {
protected:
    PageGLTest() {
        const auto painted = paint(sun.node, phong(vec3{0.8F}));
        add(painted.node, quad({-8.0F, 0.0F, 8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
        edit(painted.node)->addChild(moved.node);
        add(moved.node, box(vec3{0.0F}, vec3{1.0F}), true);
        edit(seen.viewport)->mapSize = 4096;  // 4 x 4 pages
        place(-7.0);
    }
    void place(double x) { edit(moved.core)->matrix = math::Affine{.translation = {x, 0.0, -7.0}}; }

    const scene::NodeWith<scene::DirectionalLight> sun =
        light<scene::DirectionalLight>(root, {0.2, 1.0, 0.1}, {0.0, 0.0, 0.0});
    const scene::NodeWith<scene::Transform> moved = scene::makeNode<scene::Transform>(app, "moved");
    const View seen = view(topView(), 64, 64);
};

TEST_F(PageGLTest, AStillSceneKeepsAllPages) {
    const auto first = draw(seen);
    EXPECT_EQ(first.pagesDrawn, 16U);
    EXPECT_EQ(first.pagesKept, 0U);
    EXPECT_GT(first.shadowTriangles, 0U);
    EXPECT_EQ(first.mapTexels, 16U * 1026U * 1026U);
    const auto second = draw(seen);
    EXPECT_EQ(second.pagesDrawn, 0U);
    EXPECT_EQ(second.pagesKept, 16U);
    EXPECT_EQ(second.shadowTriangles, 0U);
    EXPECT_EQ(second.mapTexels, 0U);
    EXPECT_GE(second.mapBytes, 16U * 1026U * 1026U * 4U);
}

TEST_F(PageGLTest, AMovedCasterRedrawsThePagesItWasAndIsIn) {
    draw(seen);
    const auto before = picture(seen);
    place(-6.5);
    const auto after = draw(seen);
    EXPECT_GT(after.pagesDrawn, 0U);
    EXPECT_LT(after.pagesDrawn, 16U) << "far pages hold nothing that moved";
    EXPECT_EQ(after.pagesDrawn + after.pagesKept, 16U);
    const auto afterwards = renderer->read(copyOf(seen.window));
    EXPECT_NE(before, afterwards);
    // Kept pages are as good as new ones.
    renderer->forgetShadows();
    EXPECT_EQ(draw(seen).pagesDrawn, 16U);
    EXPECT_EQ(renderer->read(copyOf(seen.window)), afterwards);
    place(-7.0);
    EXPECT_EQ(picture(seen), before);
}

TEST_F(PageGLTest, AMovedLightRedrawsAll) {
    draw(seen);
    edit(*app.get(scene::Ref<scene::Transform>{app.get(sun.core.beacon.get())->core->id}))->matrix =
        math::toAffine(
            glm::inverse(math::lookAt({0.0, 3.0, 1.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0})));
    const auto after = draw(seen);
    EXPECT_EQ(after.pagesKept, 0U);
    EXPECT_GT(after.pagesDrawn, 0U);
}

TEST_F(PageGLTest, AnAddedAndARemovedCasterAreSeen) {
    const auto without = factor(seen, sun.node);
    ASSERT_EQ(at(without, 3.0, 3.0)[0], 255);
    const auto made = transform(sun.node, {.translation = {0.0, 5.0, 0.0}});
    add(made.node, box(vec3{1.0F, 0.0F, 2.0F}, vec3{5.0F, 0.2F, 6.0F}), true);
    // The ground below it, seen from where the box does not hide it: from the factor's own shadow.
    const auto with = factor(seen, sun.node);
    EXPECT_EQ(at(with, 0.6, 3.0)[0], 0);
    edit(sun.node)->removeChild(made.node);
    ASSERT_TRUE(app.destroyTree(made.node).has_value());
    EXPECT_EQ(factor(seen, sun.node), without);
}

TEST_F(PageGLTest, AChangedMeshRedrawsItsShadow) {
    const auto before = picture(seen);
    const auto& instance =
        *app.get(scene::Ref<scene::Geometry>{app.get(moved.node.children()[0])->core->id});
    const Mesh larger = box(vec3{0.0F}, vec3{2.0F, 1.0F, 2.0F});
    {
        auto e = edit(instance);
        e->positions = payloadOf(larger.positions);
        auto chunk = instance.chunks[0];
        chunk.max = vec3{2.0F, 1.0F, 2.0F};
        e->chunks.set(0, chunk);
        e->boundsMax = chunk.max;
    }
    const auto after = draw(seen);
    EXPECT_GT(after.pagesDrawn, 0U);
    EXPECT_NE(renderer->read(copyOf(seen.window)), before);
}

TEST_F(PageGLTest, AViewThatSeesAPartDrawsItsPagesAlone) {
    // A tile of the same whole: its fit is the whole's, its pages are what it looks up.
    const auto& tile = app.create<scene::TileDecorator>();
    {
        auto e = edit(tile);
        e->decoratee = seen.viewport.camera.get();
        e->part = math::Rect{.left = 0.0, .bottom = 0.0, .width = 0.25, .height = 0.25};
    }
    edit(seen.viewport)->camera = tile;
    const auto stats = draw(seen);
    EXPECT_GT(stats.pagesDrawn, 0U);
    EXPECT_LE(stats.pagesDrawn, 4U);
    EXPECT_EQ(stats.pagesDrawn + stats.pagesUnseen, 16U);
}

// A fit makes no such maps; another program's may.
TEST_F(PageGLTest, SaysWhenThereIsNoRoomForALightsMaps) {
    draw(seen);
    const scene::ShadowState* fitted = nullptr;
    server.forEach([&](const field::FieldContainer& container) {
        if (const auto* state = dynamic_cast<const scene::ShadowState*>(&container)) fitted = state;
    });
    ASSERT_NE(fitted, nullptr);
    {
        auto e = edit(app.create<scene::ShadowState>());
        e->light = sun.node;
        e->group = fitted->group.get();
        e->mapSize = 8192;
        e->pageSize = 64;
        e->clipFromWorld.assign({math::dmat4{1.0}});
    }
    draw(seen);
    ASSERT_EQ(complaints.size(), 1U);
    EXPECT_EQ(complaints.front(),
              "1 of 2 lights shadow nothing: no room for their maps (at most 128 maps and 4096 "
              "pages)");
    draw(seen);
    EXPECT_EQ(complaints.size(), 1U) << "said once";
    complaints.clear();
}

TEST_F(PageGLTest, CountsDoNotDependOnMood) {
    const auto stats = draw(seen);
    EXPECT_EQ(stats.triangles, 14U);
    EXPECT_EQ(stats.chunks, 2U);
    EXPECT_EQ(stats.lights, 1);
    EXPECT_EQ(stats.lightsLeftOut, 0);
    EXPECT_EQ(stats.degenerate, 0);
    EXPECT_EQ(stats.shadowMs, 0.0);
    renderer->measurePasses(true);
    EXPECT_GT(draw(seen).colorMs, 0.0);
}

}  // namespace
}  // namespace gnomon::render
