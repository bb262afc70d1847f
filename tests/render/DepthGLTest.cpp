// How deep a view really is, and what the fits make of it.
#include <cmath>

#include "RenderFixture.h"

namespace gnomon::render {
namespace {

using math::vec3;

class DepthGLTest : public RenderTest {
protected:
    /// A wall across the view 10 m away, and a plate of 200 m behind it, seen by nobody.
    DepthGLTest() = default;
    void SetUp() override {
        RenderTest::SetUp();
        if (IsSkipped()) return;
        const auto lit = light<scene::DirectionalLight>(root, {1.0, 4.0, 2.0}, {0.0, 0.0, 0.0});
        sun = &lit.node;
        painted = &paint(*sun, phong(vec3{0.8F})).node;
        add(*painted, box({-20.0F, -20.0F, -10.5F}, {20.0F, 20.0F, -10.0F}), true);
        add(*painted, box({-100.0F, -1.0F, -90.0F}, {100.0F, 0.0F, -60.0F}), true);
    }
    View lookAhead(int samples = 1) {
        const View ahead = view(perspectiveView({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}), 200, 150);
        edit(ahead.window)->samples = samples;
        return ahead;
    }
    const scene::Node* sun = nullptr;
    const scene::Node* painted = nullptr;
};

TEST_F(DepthGLTest, IsOfWhatIsSeenAlone) {
    for (const int samples : {1, 4}) {
        const View ahead = lookAhead(samples);
        edit(ahead.viewport)->depthRange = scene::DepthUse::previous;
        draw(ahead);
        for (const bool drawn : {false, true}) {
            const auto span = orThrow(renderer->depthSpan(copyOf(ahead.window), drawn));
            ASSERT_TRUE(span.has_value()) << samples;
            EXPECT_NEAR(span->near, 10.0, 1e-3) << samples << drawn;
            EXPECT_NEAR(span->far, 10.0, 1e-3) << samples << drawn;
        }
        edit(ahead.viewport)->depthRange = scene::DepthUse::off;
        update();
        EXPECT_FALSE(orThrow(renderer->depthSpan(copyOf(ahead.window), true)).has_value())
            << "not asked for";
    }
}

TEST_F(DepthGLTest, OneSmallThingCounts) {
    add(*painted, box({-1.61F, -1.21F, -2.1F}, {-1.49F, -1.09F, -2.0F}), true);
    const View ahead = lookAhead();
    edit(ahead.viewport)->depthRange = scene::DepthUse::exact;
    draw(ahead);
    const auto span = orThrow(renderer->depthSpan(copyOf(ahead.window), false));
    ASSERT_TRUE(span.has_value());
    EXPECT_NEAR(span->near, 2.0, 1e-3);
    EXPECT_NEAR(span->far, 10.0, 1e-3);
}

TEST_F(DepthGLTest, WhatCanBeSeenThroughCountsByItsBox) {
    const auto& glass = phong(vec3{0.5F});
    edit(glass)->alpha = scene::PhongMaterial::Alpha::blend;
    edit(glass)->diffuse = math::vec4{0.5F, 0.5F, 0.5F, 0.5F};
    add(paint(*sun, glass).node, box({-1.0F, -1.0F, -5.0F}, {1.0F, 1.0F, -4.0F}));
    const View ahead = lookAhead();
    edit(ahead.viewport)->depthRange = scene::DepthUse::exact;
    draw(ahead);
    const auto span = orThrow(renderer->depthSpan(copyOf(ahead.window), false));
    ASSERT_TRUE(span.has_value());
    EXPECT_NEAR(span->near, 4.0, 1e-3);
    EXPECT_NEAR(span->far, 10.0, 1e-3);
}

TEST_F(DepthGLTest, WithoutAnythingSeenThereIsNone) {
    const View away = view(perspectiveView({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}), 64, 64);
    edit(away.viewport)->depthRange = scene::DepthUse::exact;
    draw(away);
    EXPECT_FALSE(orThrow(renderer->depthSpan(copyOf(away.window), false)).has_value());
}

TEST_F(DepthGLTest, MapsLeaveOutWhatIsHiddenWithAnyUseOfDepth) {
    const View ahead = lookAhead();
    // A small box before the wall, so that there is a shadow.
    add(*painted, box({-0.5F, -0.5F, -9.5F}, {0.5F, 0.5F, -9.0F}), true);
    const auto holdsPlate = [&] {
        bool holds = false;
        server.forEach([&](const field::FieldContainer& container) {
            const auto* state = dynamic_cast<const scene::ShadowState*>(&container);
            if (state == nullptr) return;
            for (const math::dmat4& map : state->clipFromWorld) {
                const math::dvec4 clip = map * math::dvec4{0.0, 0.0, -75.0, 1.0};
                holds = holds || (std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w);
            }
        });
        return holds;
    };
    draw(ahead);
    EXPECT_TRUE(holdsPlate());
    const image::Image before = factor(ahead, *sun);
    for (const auto use : {scene::DepthUse::exact, scene::DepthUse::previous}) {
        edit(ahead.viewport)->depthRange = use;
        draw(ahead);
        if (use == scene::DepthUse::previous) {
            fitter.depthSeen(orThrow(renderer->depthSpan(true)));
            draw(ahead);
        }
        EXPECT_FALSE(holdsPlate()) << static_cast<int>(use);
        // The shadow is where it was.
        const image::Image after = factor(ahead, *sun);
        int differ = 0;
        for (std::size_t i = 0; i < before.pixels.size(); ++i)
            differ += std::abs(before.pixels[i] - after.pixels[i]) > 127 ? 1 : 0;
        EXPECT_LT(differ, 60);  // along its edge, by texels
        edit(ahead.viewport)->depthRange = scene::DepthUse::off;
        draw(ahead);
        EXPECT_TRUE(holdsPlate());
    }
}

}  // namespace
}  // namespace gnomon::render
