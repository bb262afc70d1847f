#pragma once

#include <RenderFixture.h>
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>

#include <string>

namespace gnomon::stress {

/// A scene, a light and a technique, held against exact rays.
class Arena : public render::RenderTest, public testing::WithParamInterface<shadow_fit::FitInfo> {
protected:
    std::string technique() const { return std::string{GetParam().name}; }
    /// A viewport with the technique under test.
    View seen(const scene::Camera& camera, int width, int height, int mapSize);
    /// Moves what a light or camera looks from.
    void place(const scene::Node& beacon, const math::dvec3& from, const math::dvec3& to);
    /// What the viewport's picture of the light's shadow should be.
    image::Image truth(const View& view, const scene::Node& light);
    struct Both {
        image::Image truth = {};
        image::Image factor = {};
        truth::ShadowError error = {};
    };
    Both both(const View& view, const scene::Node& light);
    /// Round, of triangles, closed.
    static Mesh sphere(const math::vec3& centre, float radius, int segments);
};

using render::fitName;

/// Largest connected region of pixels that are deep in a shadow of the truth (nothing lit within
/// @p depth pixels) and lit in the picture: a shadow that was lost.
int lostShadow(const image::Image& truth, const image::Image& factor, int depth);
/// And the other way: a shadow deep in the light.
int falseShadow(const image::Image& truth, const image::Image& factor, int depth);

}  // namespace gnomon::stress
