// Random lights and cameras, held against rays: no shadow that is more than an edge is lost or made
// up, and what falls back to the plain map says so.
#include <gnomon/scene/CameraView.h>

#include <cmath>
#include <random>

#include "Arena.h"

namespace gnomon::stress {
namespace {

using math::dvec3;
using math::vec3;

/// Of each fit: 2,000 and more in all. Filters, which know of no light or camera, need fewer.
constexpr int pairs = sanitized ? 100 : 400;
constexpr int size = 128;  // pixels a side

class RaysGLTest : public Arena {
protected:
    std::mt19937 random{20051};
    double between(double low, double high) {
        return std::uniform_real_distribution<double>{low, high}(random);
    }
    dvec3 direction() {
        std::normal_distribution<double> g;
        return glm::normalize(dvec3{g(random), g(random), g(random)});
    }
    /// Boxes and balls on and above a ground.
    void yard(const scene::Node& below) {
        const auto painted = paint(below, phong(vec3{0.7F}));
        add(painted.node, quad({-20.0F, 0.0F, 20.0F}, {40.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -40.0F}));
        for (int i = 0; i < 24; ++i) {
            const vec3 low{static_cast<float>(between(-12.0, 12.0)),
                           static_cast<float>(i % 3 == 0 ? between(0.5, 4.0) : 0.0),
                           static_cast<float>(between(-12.0, 12.0))};
            const vec3 extent{static_cast<float>(between(0.4, 2.0)),
                              static_cast<float>(between(0.4, 5.0)),
                              static_cast<float>(between(0.4, 2.0))};
            if (i % 4 == 0)
                add(painted.node, sphere(low + vec3{0.0F, extent.x, 0.0F}, extent.x, 20), true);
            else
                add(painted.node, box(low, low + extent), true);
        }
    }
};

TEST_P(RaysGLTest, NoShadowIsLostOrMadeUp) {
    const auto sun = light<scene::DirectionalLight>(root, {0.0, 5.0, 0.0}, {0.0, 0.0, 0.1});
    const auto spot = light<scene::SpotLight>(sun.node, {0.0, 9.0, 0.0}, {0.0, 0.0, 0.1});
    yard(spot.node);
    const auto& lens = perspectiveView({0.0, 5.0, 9.0}, {0.0, 0.0, 0.0});
    const View eye = seen(lens, size, size, 1024);
    int shadowed = 0;
    int degenerate = 0;
    double wrong = 0.0;
    const int wanted = GetParam().hard() ? pairs : pairs / 4;
    for (int i = 0; i < wanted; ++i) {
        const bool useSun = i % 2 == 0;
        // From above the ground, as low as two degrees.
        dvec3 toward = direction();
        toward.y = std::max(std::abs(toward.y), 0.035);
        const dvec3 aim{between(-6.0, 6.0), 0.0, between(-6.0, 6.0)};
        if (useSun) {
            place(*app.get(sun.core.beacon.get()), toward * 5.0, dvec3{0.0});
        } else {
            place(*app.get(spot.core.beacon.get()),
                  aim + glm::normalize(toward) * between(6.0, 25.0), aim);
            edit(spot.core)->outerAngle = static_cast<float>(between(0.1, 1.2));
        }
        dvec3 from = direction() * between(3.0, 25.0);
        from.y = std::abs(from.y) + 0.3;
        // Every eighth along the light, or against it.
        const dvec3 to = i % 8 == 3 ? from - toward
                         : i % 8 == 7
                             ? from + toward
                             : dvec3{between(-8.0, 8.0), between(0.0, 3.0), between(-8.0, 8.0)};
        place(*app.get(lens.beacon.get()), from, to);
        {
            auto e = edit(lens);
            e->fovy = between(0.3, 1.9);
            e->far = between(30.0, 200.0);
        }
        const scene::Node& light = useSun ? sun.node : spot.node;
        const auto made = both(eye, light);
        degenerate += draw(eye).degenerate;
        if (made.error.counted < 100) continue;
        for (const std::uint8_t value : made.truth.pixels) shadowed += value == 0 ? 1 : 0;
        wrong += made.error.share(made.error.wrong);
        ASSERT_LE(lostShadow(made.truth, made.factor, 3), 4) << "pair " << i;
        // A texel that lies across a crease is compared with the wrong plane: a line of pixels.
        ASSERT_LE(falseShadow(made.truth, made.factor, 3), 12) << "pair " << i;
    }
    if (!GetParam().filter.bleeds) {
        EXPECT_GT(shadowed, 200 * wanted) << "the test saw few shadows";
    }
    EXPECT_LT(wrong / wanted, 0.02);
    if (technique() == plain()) {
        EXPECT_EQ(degenerate, 0);
    }
    RecordProperty("degenerate", degenerate);
    RecordProperty("wrongPercent", std::to_string(100.0 * wrong / wanted));
    std::printf("%s: %.3f %% wrong in the mean, %d of %d fits fell back to the plain map\n",
                technique().c_str(), 100.0 * wrong / wanted, degenerate, wanted);
}

INSTANTIATE_TEST_SUITE_P(All, RaysGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::stress
