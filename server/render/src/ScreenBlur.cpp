#include "ScreenBlur.h"

#include <algorithm>

namespace gnomon::render {
namespace {

constexpr int pixelsPerBlock = 16;  // as in BlurGlsl.cpp
constexpr GLuint surfacesUnit = 11;
constexpr GLuint kernelsUnit = 12;
constexpr GLuint factorsUnit = 13;
constexpr GLuint rangesUnit = 14;
constexpr GLuint blocksUnit = 15;

}  // namespace

ScreenBlur::ScreenBlur(const gl::Api& gl, Programs& programs)
    : gl_{gl}, programs_{programs}, scene_{gl}, one_{gl}, empty_{gl} {
    scene_.label("unblurred factors");
    one_.label("blurred factors");
}

math::View ScreenBlur::widened(const math::View& view, const glm::ivec2& pixels) {
    const math::dvec2 share = math::dvec2{margin} / math::dvec2{pixels};
    return {.clipFromEye = math::tileFromWhole({.left = -share.x,
                                                .bottom = -share.y,
                                                .width = 1.0 + 2.0 * share.x,
                                                .height = 1.0 + 2.0 * share.y}) *
                           view.clipFromEye,
            .eyeFromWorld = view.eyeFromWorld};
}

gl::Texture ScreenBlur::texture(GLenum target, GLenum format, const glm::ivec2& size, int layers,
                                const char* label) const {
    gl::Texture made{gl_, target};
    made.label(label);
    if (target == GL_TEXTURE_2D_ARRAY)
        gl_.TextureStorage3D(made.id(), 1, format, size.x, size.y, layers);
    else
        gl_.TextureStorage2D(made.id(), 1, format, size.x, size.y);
    gl_.TextureParameteri(made.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TextureParameteri(made.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return made;
}

void ScreenBlur::start(const Pass& pass) {
    const bool resized = pass.pixels != pass_.pixels;
    const bool more = pass.maps.lights > layers_;
    pass_ = pass;
    made_ = false;
    if (!resized && !more) return;
    layers_ = std::max(layers_, pass.maps.lights);
    blockCount_ = (size() + pixelsPerBlock - 1) / pixelsPerBlock;
    const glm::ivec2 whole = blockCount_ * pixelsPerBlock;
    const GLenum flat = GL_TEXTURE_2D;
    const GLenum array = GL_TEXTURE_2D_ARRAY;
    surfaces_ = texture(flat, GL_RG32UI, whole, 1, "surfaces");
    kernels_ = texture(array, GL_RGBA16, whole, std::min(layers_, atOnce), "kernels");
    for (gl::Texture& factors : factors_)
        factors = texture(array, GL_R16, whole, layers_, "shadow factors");
    depth_ = texture(flat, GL_DEPTH_COMPONENT32F, whole, 1, "depth of surfaces");
    ranges_ = texture(flat, GL_RGBA16, blockCount_, 1, "ranges of factors");
    blocks_ = texture(flat, GL_R8, blockCount_, 1, "blocks to blur");
    gl_.NamedFramebufferTexture(scene_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    gl_.NamedFramebufferTexture(scene_.id(), GL_COLOR_ATTACHMENT0, surfaces_.id(), 0);
}

void ScreenBlur::begin(int firstLight, int lightCount) {
    std::array<GLenum, 1 + 2 * atOnce> buffers{GL_COLOR_ATTACHMENT0};
    for (int i = 0; i < 2 * atOnce; ++i) {
        const bool kernel = i < lightCount;
        const GLenum place = GL_COLOR_ATTACHMENT1 + static_cast<GLenum>(i);
        if (i < 2 * lightCount) {
            buffers[static_cast<std::size_t>(i) + 1] = place;
            gl_.NamedFramebufferTextureLayer(scene_.id(), place,
                                             kernel ? kernels_.id() : factors_[0].id(), 0,
                                             kernel ? i : firstLight + i - lightCount);
        } else {
            gl_.NamedFramebufferTexture(scene_.id(), place, 0, 0);
        }
    }
    gl_.NamedFramebufferDrawBuffers(scene_.id(), 1 + 2 * lightCount, buffers.data());
    gl_.BindFramebuffer(GL_FRAMEBUFFER, scene_.id());
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Viewport(0, 0, size().x, size().y);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.DepthMask(GL_TRUE);
    const float farthest = 0.0F;
    gl_.ClearNamedFramebufferfv(scene_.id(), GL_DEPTH, 0, &farthest);
    // Where there is no surface nothing is told but that.
    const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
    for (int i = 0; i < lightCount; ++i)
        gl_.ClearNamedFramebufferfv(scene_.id(), GL_COLOR, 1 + lightCount + i, nothing.data());
}

void ScreenBlur::attach(GLuint texture, int layer) const {
    if (layer < 0)
        gl_.NamedFramebufferTexture(one_.id(), GL_COLOR_ATTACHMENT0, texture, 0);
    else
        gl_.NamedFramebufferTextureLayer(one_.id(), GL_COLOR_ATTACHMENT0, texture, 0, layer);
}

void ScreenBlur::findBlocks(const glm::ivec2& layers) {
    gl_.Viewport(0, 0, blockCount_.x, blockCount_.y);
    const GLuint ranges = programs_.blurRanges();
    gl_.UseProgram(ranges);
    gl_.ProgramUniform4i(ranges, 0, layers.x, layers.y, 0, 0);
    gl_.BindTextureUnit(factorsUnit, factors_[0].id());
    attach(ranges_.id(), -1);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.UseProgram(programs_.blurBlocks());
    attach(blocks_.id(), -1);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenBlur::drawPass(const glm::ivec2& layers, int from, const math::vec4& pass) {
    const GLuint program = programs_.blur();
    const auto source = static_cast<std::size_t>(from);
    gl_.ProgramUniform4i(program, 0, layers.x, layers.y, 0, 0);
    gl_.ProgramUniform4f(program, 1, pass.x, pass.y, pass.z, pass.w);
    gl_.BindTextureUnit(factorsUnit, factors_[source].id());
    attach(factors_[1 - source].id(), layers.x);
    gl_.DrawArrays(GL_TRIANGLES, 0, 6 * blockCount_.x * blockCount_.y);
}

void ScreenBlur::blur(int firstLight, int lightCount) {
    const glm::ivec2 whole = blockCount_ * pixelsPerBlock;
    // What is not blurred stays as it is.
    gl_.CopyImageSubData(factors_[0].id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, firstLight,
                         factors_[1].id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, firstLight, whole.x,
                         whole.y, lightCount);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, one_.id());
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.BindVertexArray(empty_.id());
    gl_.BindTextureUnit(surfacesUnit, surfaces_.id());
    gl_.BindTextureUnit(kernelsUnit, kernels_.id());
    gl_.BindTextureUnit(rangesUnit, ranges_.id());
    gl_.BindTextureUnit(blocksUnit, blocks_.id());
    const GLuint program = programs_.blur();
    const math::mat4 eyeFromClip{glm::inverse(pass_.clipFromEye)};
    gl_.ProgramUniformMatrix4fv(program, 4, 1, GL_FALSE, &eyeFromClip[0][0]);
    gl_.ProgramUniform2i(program, 2, size().x, size().y);
    for (int i = 0; i < lightCount; ++i) {
        const glm::ivec2 layers{firstLight + i, i};
        findBlocks(layers);
        gl_.Viewport(0, 0, whole.x, whole.y);
        gl_.UseProgram(program);
        drawPass(layers, 0, {1.0F, 0.0F, 0.0F, 0.0F});
        drawPass(layers, 1, {0.0F, 1.0F, 0.0F, 0.0F});
        drawPass(layers, 0, {0.0F, 0.0F, 1.0F, 0.0F});
    }
    gl_.Enable(GL_DEPTH_TEST);
    made_ = true;
}

void ScreenBlur::bind() const { gl_.BindTextureUnit(factorUnit, factors_[1].id()); }

std::uint64_t ScreenBlur::bytes() const noexcept {
    const glm::ivec2 whole = blockCount_ * pixelsPerBlock;
    const auto pixels = static_cast<std::uint64_t>(whole.x) * static_cast<std::uint64_t>(whole.y);
    const auto layers = static_cast<std::uint64_t>(layers_);
    return pixels * (8U + 4U + 8U * std::min<std::uint64_t>(layers, atOnce) + 4U * layers);
}

}  // namespace gnomon::render
