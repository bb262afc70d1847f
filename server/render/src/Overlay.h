#pragma once

#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/Window.h>

#include "Programs.h"
#include "TextureStore.h"

namespace gnomon::render {

/// What lies behind and in front of the scene.
class Overlay {
public:
    Overlay(const gl::Api& gl, Programs& programs, TextureStore& textures)
        : gl_{gl}, programs_{programs}, textures_{textures}, empty_{gl} {}

    /// Fills the pixels nothing was drawn on (depth still cleared). @param part of the whole
    /// picture.
    void drawBackground(const field::Aspect& scene, const scene::Viewport& viewport,
                        const math::Rect& part);
    void drawForegrounds(const field::Aspect& scene, const scene::Viewport& viewport,
                         const scene::PixelRect& pixels);

private:
    const gl::Api& gl_;
    Programs& programs_;
    TextureStore& textures_;
    gl::VertexArray empty_;
};

}  // namespace gnomon::render
