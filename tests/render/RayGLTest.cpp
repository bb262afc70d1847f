// Technique ray: exact, and traced only when something changed.
#include <cmath>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::vec3;

class RayGLTest : public RenderTest {
protected:
    const math::Box caster{.min = {-1.0, 0.0, -1.0}, .max = {1.0, 2.0, 1.0}};

    void stage(const scene::Node& below) {
        const auto ground = paint(below, phong(vec3{0.8F}));
        add(ground.node, quad({-10.0F, 0.0F, 10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -20.0F}));
        moving = &transform(ground.node).node;
        add(*moving, box(vec3{-1.0F, 0.0F, -1.0F}, vec3{1.0F, 2.0F, 1.0F}), true);
    }
    View traced() {
        const View made = view(topView(), 256, 256);
        edit(made.viewport)->technique = "ray";
        return made;
    }
    /// Pixels of the ground whose factor is not the ray's to the light.
    template <class Way>
    int wrong(const image::Image& found, double reach, Way wayToLight, double shift = 0.0) {
        int count = 0;
        for (int y = 0; y < found.height; ++y)
            for (int x = 0; x < found.width; ++x) {
                const dvec3 p{(x + 0.5) / 16.0 - 8.0 - shift, 0.0, (y + 0.5) / 16.0 - 8.0};
                if (std::max(std::abs(p.x), std::abs(p.z)) < 1.02) continue;
                const bool dark = blocks(caster, p, wayToLight(p + dvec3{shift, 0.0, 0.0}), reach);
                count += (pixel(found, x, y)[0] < 128) != dark ? 1 : 0;
            }
        return count;
    }
    const scene::Node* moving = nullptr;
};

TEST_F(RayGLTest, EveryPixelIsAsItsRaySays) {
    const dvec3 toward{1.3, 2.0, 0.7};
    const auto sun = light<scene::DirectionalLight>(root, toward, {0.0, 0.0, 0.0});
    stage(sun.node);
    const View eye = traced();
    const auto along = [&](const dvec3&) { return toward; };
    EXPECT_LE(wrong(factor(eye, sun.node), 1e9, along), 6);
    // Refitted, not built anew.
    edit(*app.get(scene::Ref<scene::Transform>{moving->core->id}))->matrix =
        math::Affine{.translation = {2.0, 0.0, 0.0}};
    EXPECT_LE(wrong(factor(eye, sun.node), 1e9, along, 2.0), 6);
}

TEST_F(RayGLTest, APointLightShinesAllRound) {
    const dvec3 lamp{3.1, 4.0, 1.3};
    const auto bulb = light<scene::PointLight>(root, lamp, {0.0, 0.0, 0.0});
    stage(bulb.node);
    EXPECT_LE(wrong(factor(traced(), bulb.node), 1.0, [&](const dvec3& p) { return lamp - p; }), 6);
}

TEST_F(RayGLTest, ThePictureIsThatOfAFineMap) {
    const auto sun = light<scene::DirectionalLight>(root, {1.0, 2.0, 0.5}, {0.0, 0.0, 0.0});
    stage(sun.node);
    const View eye = traced();
    const auto rays = picture(eye);
    {
        auto e = edit(eye.viewport);
        e->technique = "std";
        e->mapSize = 4096;
    }
    const auto maps = picture(eye);
    int different = 0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            different += std::abs(pixel(rays, x, y)[0] - pixel(maps, x, y)[0]) > 64 ? 1 : 0;
    EXPECT_LT(different, 60) << "along the edges";
}

TEST_F(RayGLTest, AMovedLightMovesItsShadow) {
    const auto sun = light<scene::DirectionalLight>(root, {1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    stage(sun.node);
    const View eye = traced();
    const auto before = picture(eye);
    EXPECT_LT(at(before, -1.5, 0.0)[0], at(before, 1.5, 0.0)[0]);
    edit(*app.get(scene::Ref<scene::Transform>{app.get(sun.core.beacon.get())->core->id}))->matrix =
        lookFrom({-1.0, 2.0, 0.0}, {0.0, 0.0, 0.0});
    const auto after = picture(eye);
    EXPECT_GT(at(after, -1.5, 0.0)[0], at(after, 1.5, 0.0)[0]);
}

}  // namespace
}  // namespace gnomon::render
