// Both eyes see the same shadow in the same place of the world, whatever fits the map.
#include <gnomon/scene/CameraView.h>

#include <cmath>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::dvec3;
using math::vec3;

class EyeGLTest : public RenderTest, public testing::WithParamInterface<Technique> {};

/// The ground's factor, looked up in an eye's picture at a place of the world.
int factorAt(const image::Image& factor, const math::View& view, const dvec3& world) {
    const math::dvec4 clip = view.clipFromWorld() * math::dvec4{world, 1.0};
    const auto x = static_cast<int>((clip.x / clip.w * 0.5 + 0.5) * factor.width);
    const auto y = static_cast<int>((0.5 - clip.y / clip.w * 0.5) * factor.height);
    if (x < 0 || y < 0 || x >= factor.width || y >= factor.height) return -1;
    return factor.pixels[static_cast<std::size_t>(y * factor.width + x)];
}

TEST_P(EyeGLTest, AShadowsEdgeIsAtOnePlaceOfTheWorld) {
    const auto sun = light<scene::DirectionalLight>(root, {-3.0, 4.0, 2.0}, {0.0, 0.0, 0.0});
    const auto painted = paint(sun.node, phong(vec3{0.8F}));
    add(painted.node, quad({-20.0F, 0.0F, 6.0F}, {40.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -40.0F}));
    // A plate at the height of the eyes, which hides nothing of the ground.
    add(painted.node, box({-1.0F, 2.99F, -3.0F}, {1.0F, 3.01F, -1.0F}), true);
    const auto& lens = perspectiveView({0.0, 3.0, 8.0}, {0.5, 0.0, -2.0});
    std::vector<View> eyes;
    std::vector<const scene::StereoDecorator*> cameras;
    for (const scene::Eye eye : {scene::Eye::left, scene::Eye::right}) {
        const auto& camera = app.create<scene::StereoDecorator>();
        {
            auto e = edit(camera);
            e->decoratee = lens;
            e->eye = eye;
            e->eyeSeparation = 0.3;  // more than a person's, so that a difference would show
        }
        cameras.push_back(&camera);
        eyes.push_back(view(camera, 512, 384));
        auto e = edit(eyes.back().viewport);
        e->technique = GetParam().word();
        e->mapSize = 256;  // texels that many pixels see
    }
    update();
    std::array<image::Image, 2> factors;
    std::array<math::View, 2> views;
    for (std::size_t i = 0; i < 2; ++i) {
        factors[i] = factor(eyes[i], sun.node);
        views[i] = orThrow(scene::cameraView(server, scene::Ref<scene::Camera>{cameras[i]->id()},
                                             512.0 / 384.0))
                       .view;
    }
    // Along lines on the ground, across the shadow: where the factor passes one half.
    int edges = 0;
    for (double z = -5.0; z < -2.0; z += 0.1) {
        std::array<std::vector<double>, 2> crossings;
        for (std::size_t i = 0; i < 2; ++i) {
            int before = -1;
            for (double x = -1.0; x < 5.0; x += 0.005) {
                const int value = factorAt(factors[i], views[i], {x, 0.0, z});
                if (before >= 0 && value >= 0 && (before > 127) != (value > 127))
                    crossings[i].push_back(x);
                before = value;
            }
        }
        if (crossings[0].size() != crossings[1].size()) continue;  // along an edge
        for (std::size_t k = 0; k < crossings[0].size(); ++k) {
            ++edges;
            // A pixel is up to 4 cm wide here, and each eye's edge is found to half of one; a texel
            // of the map is several times that. Noise may pass one half twice within a pixel.
            const double apart = GetParam().filter.name == "rotated" ? 0.085 : 0.045;
            EXPECT_NEAR(crossings[0][k], crossings[1][k], apart) << "z " << z;
        }
    }
    EXPECT_GT(edges, 30) << "the test saw few edges";
}

INSTANTIATE_TEST_SUITE_P(All, EyeGLTest, testing::ValuesIn(techniques()), techniqueName);

}  // namespace
}  // namespace gnomon::render
