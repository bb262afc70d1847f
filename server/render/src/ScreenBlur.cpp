#include "ScreenBlur.h"

#include <algorithm>

#include "Glsl.h"

namespace gnomon::render {
namespace {

constexpr int pixelsPerBlock = 16;  // as in BlurGlsl.cpp
constexpr GLuint surfacesUnit = 11;
constexpr GLuint kernelsUnit = 12;
constexpr GLuint rangesUnit = 14;
constexpr GLuint blocksUnit = 15;

}  // namespace

ScreenBlur::ScreenBlur(const gl::Api& gl, Programs& programs)
    : gl_{gl}, programs_{programs}, scene_{gl}, one_{gl}, empty_{gl} {
    scene_.label("unblurred factors");
    one_.label("blurred factors");
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
    const int some = std::min(layers_, atOnce);
    for (gl::Texture& surfaces : surfaces_)
        surfaces = texture(GL_TEXTURE_2D_ARRAY, GL_RG32UI, whole, some, "surfaces");
    kernels_ = texture(GL_TEXTURE_2D_ARRAY, GL_RGBA16, whole, some, "kernels");
    factors_ = texture(GL_TEXTURE_2D_ARRAY, GL_R16, whole, layers_, "shadow factors");
    depth_ = texture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, whole, 1, "depth of surfaces");
    ranges_ = texture(GL_TEXTURE_2D, GL_RGBA16, blockCount_, 1, "ranges of factors");
    blocks_ = texture(GL_TEXTURE_2D, GL_R8, blockCount_, 1, "blocks to blur");
    gl_.NamedFramebufferTexture(scene_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
}

void ScreenBlur::begin(int firstLight, int lightCount) {
    std::array<GLenum, 3 * atOnce> buffers{};
    for (int i = 0; i < 3 * atOnce; ++i) {
        const GLenum place = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        buffers[static_cast<std::size_t>(i)] = place;
        const int light = i % lightCount;
        const auto attach = [&](const gl::Texture& texture, int layer) {
            gl_.NamedFramebufferTextureLayer(scene_.id(), place, texture.id(), 0, layer);
        };
        if (i < lightCount)
            attach(surfaces_[0], light);
        else if (i < 2 * lightCount)
            attach(kernels_, light);
        else if (i < 3 * lightCount)
            attach(factors_, firstLight + light);
        else
            gl_.NamedFramebufferTexture(scene_.id(), place, 0, 0);
    }
    gl_.NamedFramebufferDrawBuffers(scene_.id(), 3 * lightCount, buffers.data());
    gl_.BindFramebuffer(GL_FRAMEBUFFER, scene_.id());
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Viewport(0, 0, size().x, size().y);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.DepthMask(GL_TRUE);
    const float farthest = 0.0F;
    gl_.ClearNamedFramebufferfv(scene_.id(), GL_DEPTH, 0, &farthest);
    // Without a factor, where there is no surface: nothing else is read there.
    const std::array<GLuint, 4> nothing{};
    for (int i = 0; i < lightCount; ++i)
        gl_.ClearNamedFramebufferuiv(scene_.id(), GL_COLOR, i, nothing.data());
}

void ScreenBlur::findBlocks(int layer) {
    gl_.Viewport(0, 0, blockCount_.x, blockCount_.y);
    const GLuint ranges = programs_.blurRanges();
    gl_.UseProgram(ranges);
    gl_.ProgramUniform1i(ranges, 0, layer);
    gl_.BindTextureUnit(surfacesUnit, surfaces_[0].id());
    gl_.NamedFramebufferTexture(one_.id(), GL_COLOR_ATTACHMENT0, ranges_.id(), 0);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.UseProgram(programs_.blurBlocks());
    gl_.NamedFramebufferTexture(one_.id(), GL_COLOR_ATTACHMENT0, blocks_.id(), 0);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenBlur::drawPass(GLuint program, int layer, const gl::Texture& from, const gl::Texture& to,
                          int toLayer, const math::vec3& pass) {
    gl_.UseProgram(program);
    gl_.ProgramUniform4f(program, 1, pass.x, pass.y, pass.z, 0.0F);
    gl_.ProgramUniform1i(program, 0, layer);
    gl_.BindTextureUnit(surfacesUnit, from.id());
    gl_.NamedFramebufferTextureLayer(one_.id(), GL_COLOR_ATTACHMENT0, to.id(), 0, toLayer);
    gl_.DrawArrays(GL_TRIANGLES, 0, 6 * blockCount_.x * blockCount_.y);
}

void ScreenBlur::blur(int firstLight, int lightCount) {
    const glm::ivec2 whole = blockCount_ * pixelsPerBlock;
    // What is not blurred stays as it is.
    gl_.CopyImageSubData(surfaces_[0].id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, surfaces_[1].id(),
                         GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, whole.x, whole.y, lightCount);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, one_.id());
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.BindVertexArray(empty_.id());
    gl_.BindTextureUnit(kernelsUnit, kernels_.id());
    gl_.BindTextureUnit(rangesUnit, ranges_.id());
    gl_.BindTextureUnit(blocksUnit, blocks_.id());
    const GLuint program = programs_.blur(false);
    const GLuint last = programs_.blur(true);
    const math::mat4 eyeFromClip{glm::inverse(pass_.clipFromEye)};
    for (const GLuint each : {program, last}) {
        gl_.ProgramUniformMatrix4fv(each, 4, 1, GL_FALSE, &eyeFromClip[0][0]);
        gl_.ProgramUniform2i(each, 2, size().x, size().y);
    }
    for (int i = 0; i < lightCount; ++i) {
        findBlocks(i);
        gl_.Viewport(0, 0, whole.x, whole.y);
        drawPass(program, i, surfaces_[0], surfaces_[1], i, {1.0F, 0.0F, 0.0F});
        drawPass(program, i, surfaces_[1], surfaces_[0], i, {0.0F, 1.0F, 0.0F});
        drawPass(last, i, surfaces_[0], factors_, firstLight + i, {0.0F, 0.0F, 1.0F});
    }
    gl_.Enable(GL_DEPTH_TEST);
    made_ = true;
}

void ScreenBlur::bind() const { gl_.BindTextureUnit(glsl::factorUnit, factors_.id()); }

std::uint64_t ScreenBlur::bytes() const noexcept {
    const glm::ivec2 whole = blockCount_ * pixelsPerBlock;
    const auto pixels = static_cast<std::uint64_t>(whole.x) * static_cast<std::uint64_t>(whole.y);
    const auto layers = static_cast<std::uint64_t>(layers_);
    return pixels * (4U + 24U * std::min<std::uint64_t>(layers, atOnce) + 2U * layers);
}

}  // namespace gnomon::render
