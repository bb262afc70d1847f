#pragma once

#include <gnomon/scene/CameraView.h>

#include <optional>
#include <utility>
#include <vector>

#include "Programs.h"

namespace gnomon::render {

/// Finds the least and the greatest depth in a part of a depth image: a pass that draws one pixel
/// for each block of pixels, and a small read back.
class DepthReducer {
public:
    DepthReducer(const gl::Api& gl, Programs& programs) : gl_{gl}, programs_{programs} {}

    /// @param depth  a 2D texture of depths, 0 where nothing is
    /// Least and greatest of what is not 0; nothing where all is.
    std::optional<std::pair<float, float>> reduce(GLuint depth, const scene::PixelRect& pixels);

private:
    const gl::Api& gl_;
    Programs& programs_;
    glm::ivec2 size_{0};
    gl::Texture blocks_;
    gl::Framebuffer framebuffer_;
    gl::VertexArray empty_{gl_};
    std::vector<glm::vec2> read_;
};

}  // namespace gnomon::render
