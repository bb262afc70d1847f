#pragma once

#include <RenderFixture.h>
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>

#include <string>

namespace gnomon::stress {

using render::Technique;
using render::techniqueName;
using render::techniques;

/// Built under a sanitizer (GNOMON_SANITIZE): an order of magnitude slower, and looked at for what
/// a sanitizer sees, not for rare pictures.
#ifdef GNOMON_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// A scene, a light and a technique, held against exact rays. A test that failed leaves its last
/// picture, the errors in red and blue, in stress/ beside the programs' folder.
class Arena : public render::RenderTest, public testing::WithParamInterface<Technique> {
protected:
    void TearDown() override;

    std::string technique() const { return GetParam().word(); }
    /// What it is compared with: the plain map, looked up the same way.
    std::string plain() const { return "std+" + std::string{GetParam().filter.name}; }
    /// A viewport with the technique under test.
    View seen(const scene::Camera& camera, int width, int height, int mapSize);
    /// Moves what a light or camera looks from.
    void place(const scene::Node& beacon, const math::dvec3& from, const math::dvec3& to);
    /// What the viewport's picture of the light's shadow should be. A filter that is not hard blurs
    /// edges, so that where its reach in the map sees both light and shadow there is nothing to be
    /// said: there the truth is truth::noSurface, which nothing counts.
    /// @param beyondTexels  of the hard filter, too: for maps whose texels are many pixels
    image::Image truth(const View& view, const scene::Node& light, bool beyondTexels = false);
    struct Both {
        image::Image truth = {};
        image::Image factor = {};
        truth::ShadowError error = {};
    };
    Both both(const View& view, const scene::Node& light, bool beyondTexels = false);
    /// The light's maps for the view, as the server has them.
    const scene::ShadowState* stateOf(const View& view, const scene::Node& light) const;
    std::vector<math::dmat4> mapsOf(const View& view, const scene::Node& light) const;
    /// Takes a part of the scene and a view away again.
    void remove(const scene::Node& node, const View& view);
    /// Round, of triangles, closed.
    static Mesh sphere(const math::vec3& centre, float radius, int segments);

private:
    struct Rays;
    bool mixed(const Rays& rays, const math::dvec3& position, const math::dvec3& normal) const;
    Both last_;
};

/// Largest connected region of pixels that are deep in a shadow of the truth (nothing lit within
/// @p depth pixels) and lit in the picture: a shadow that was lost.
int lostShadow(const image::Image& truth, const image::Image& factor, int depth);
/// And the other way: a shadow deep in the light.
int falseShadow(const image::Image& truth, const image::Image& factor, int depth);

}  // namespace gnomon::stress
