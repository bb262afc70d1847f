#include "DepthReducer.h"

#include <algorithm>

namespace gnomon::render {
namespace {

constexpr int blockSide = 32;  // as in Glsl.cpp

}  // namespace

std::optional<std::pair<float, float>> DepthReducer::reduce(GLuint depth,
                                                            const scene::PixelRect& pixels) {
    const glm::ivec2 size{(pixels.width + blockSide - 1) / blockSide,
                          (pixels.height + blockSide - 1) / blockSide};
    if (size.x <= 0 || size.y <= 0) return {};
    if (size != size_) {
        size_ = size;
        blocks_ = gl::Texture{gl_, GLenum{GL_TEXTURE_2D}};
        blocks_.label("depth blocks");
        gl_.TextureStorage2D(blocks_.id(), 1, GL_RG32F, size.x, size.y);
        framebuffer_ = gl::Framebuffer{gl_};
        gl_.NamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, blocks_.id(), 0);
        read_.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    }
    const GLuint program = programs_.depthRange();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl_.Viewport(0, 0, size.x, size.y);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.UseProgram(program);
    gl_.ProgramUniform4i(program, 0, pixels.x, pixels.y, pixels.width, pixels.height);
    gl_.BindTextureUnit(3, depth);
    gl_.BindVertexArray(empty_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.ReadPixels(0, 0, size.x, size.y, GL_RG, GL_FLOAT, read_.data());
    float least = 1.0F;
    float greatest = 0.0F;
    for (const glm::vec2& block : read_) {
        if (!(block.y > 0.0F)) continue;
        least = std::min(least, block.x);
        greatest = std::max(greatest, block.y);
    }
    if (!(greatest > 0.0F)) return {};
    return std::pair{least, greatest};
}

}  // namespace gnomon::render
