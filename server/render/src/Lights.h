#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/math/View.h>
#include <gnomon/scene/FlatScene.h>
#include <gnomon/scene/Window.h>
#include <gnomon/shadow/ShadowMaps.h>

#include <vector>

#include "RayShadows.h"

namespace gnomon::render {

/// The lights and the view, as the surface shaders read them.
class Lights {
public:
    static constexpr GLuint lightBinding = 1;
    static constexpr GLuint viewBinding = 2;

    explicit Lights(const gl::Api& gl);

    struct Uploaded {
        int count = 0;
        int unseen = 0;       ///< others reach nothing that is seen
        int directional = 0;  ///< the first of them
        bool scoped = false;  ///< some surface is not lit by all of them
        shadow::ShadowMaps::Arranged maps = {};
        std::vector<RayShadows::Light> traced = {};  ///< lights whose shadows are
    };
    /// Writes what reaches the view; binds both blocks, and the shadow maps in the lights' order.
    /// @param imagesAt  the pixel of images of factors that the window's first one is
    /// @param only  -1: all that are on; else just this one, at index 0, on or off.
    Uploaded upload(const scene::FlatScene& flat, const math::View& view, const math::dvec3& origin,
                    const scene::Viewport& viewport, shadow::ShadowMaps* maps,
                    const glm::ivec2& imagesAt, int only = -1);

private:
    const gl::Api& gl_;
    gl::Buffer lights_;
    gl::Buffer view_;
};

}  // namespace gnomon::render
