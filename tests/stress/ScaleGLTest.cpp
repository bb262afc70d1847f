// Far from the origin, tiny, huge: the same scene gives the same shadow.
#include <cmath>

#include "Arena.h"

namespace gnomon::stress {
namespace {

using math::dvec3;
using math::vec3;

class ScaleGLTest : public Arena {
protected:
    /// A small still life under a transform, seen from a place that goes along.
    Both stillLife(const dvec3& origin, double scale) {
        const auto sun = light<scene::DirectionalLight>(root, {-3.0, 4.0, 2.0}, {0.0, 0.0, 0.0});
        const auto moved = transform(
            sun.node, {.translation = origin, .linear = math::mat3{static_cast<float>(scale)}});
        const auto painted = paint(moved.node, phong(vec3{0.8F}));
        add(painted.node, quad({-8.0F, 0.0F, 8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -16.0F}));
        add(painted.node, box({-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}), true);
        add(painted.node, sphere({2.5F, 0.8F, 1.0F}, 0.8F, 24), true);
        const auto& lens = perspectiveView(origin + dvec3{4.0, 4.0, 8.0} * scale, origin);
        {
            auto e = edit(lens);
            e->near = 0.1 * scale;
            e->far = 100.0 * scale;
        }
        const View eye = seen(lens, 256, 256, 512);
        edit(eye.viewport)->softness = static_cast<float>(0.05 * scale);
        Both made = both(eye, sun.node);
        edit(root)->removeChild(sun.node);
        EXPECT_TRUE(app.destroyTree(sun.node).has_value());
        EXPECT_TRUE(app.destroyTree(eye.window).has_value());
        return made;
    }
    static std::uint64_t differing(const image::Image& a, const image::Image& b) {
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            count += (a.pixels[i] > 127) != (b.pixels[i] > 127) ? 1U : 0U;
        return count;
    }
};

/// Along the foot of the box some texels lie on both sides of a crease, and are compared with the
/// wrong one's plane. Where one depth is compared with all four texels, a texel farther.
std::uint64_t creasePixels(const Technique& technique) {
    return technique.filter.name == "hardware" ? 16 : 8;
}

// Stress case 10.
TEST_P(ScaleGLTest, FarFromTheOriginTheShadowIsTheSame) {
    const auto here = stillLife(dvec3{0.0}, 1.0);
    EXPECT_LT(here.error.share(here.error.wrong), 0.01);
    for (const double far : {1e3, 1e5, 1e7}) {
        const auto there = stillLife({far, -0.3 * far, 0.7 * far}, 1.0);
        EXPECT_LE(there.error.interior, creasePixels(GetParam())) << far << " m";
        // Edges may fall on the other side of a pixel: the map's grid lies elsewhere.
        EXPECT_LT(differing(here.factor, there.factor), 400U) << far << " m";
    }
}

// Stress case 11, and what an application in millimetres or in kilometres does.
TEST_P(ScaleGLTest, TinyAndHugeScenesAreTheSame) {
    const auto usual = stillLife(dvec3{0.0}, 1.0);
    for (const double scale : {1e-3, 1e3, 1e5}) {
        const auto scaled = stillLife(dvec3{0.0}, scale);
        EXPECT_LE(scaled.error.interior, creasePixels(GetParam())) << scale;
        EXPECT_LT(differing(usual.factor, scaled.factor), 400U) << scale;
    }
}

INSTANTIATE_TEST_SUITE_P(All, ScaleGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::stress
