#include "Pyramid.h"

#include <gnomon/gl/Shader.h>

#include <array>
#include <bit>
#include <string>

namespace gnomon::shadow {
namespace {

constexpr std::string_view header = R"glsl(#version 450 core
layout(binding = 0) uniform sampler2DArray source;
layout(location = 0) uniform int layer;
layout(location = 1) uniform int level;      // that is made
layout(location = 2) uniform float texel;    // of the page with its border, a share of its side
layout(location = 0) out vec4 made;
)glsl";

constexpr std::string_view cover = R"glsl(#version 450 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)glsl";

constexpr std::string_view firstMain = R"glsl(
void main() { made = firstLevel(ivec2(gl_FragCoord.xy)); }
)glsl";
constexpr std::string_view nextMain = R"glsl(
void main() { made = nextLevel(ivec2(gl_FragCoord.xy)); }
)glsl";

}  // namespace

Pyramid::Pyramid(const gl::Api& gl, const PyramidInfo& info, int pageSize)
    : gl_{gl},
      info_{info},
      pageSize_{pageSize},
      side_{static_cast<int>(std::bit_ceil(
          static_cast<unsigned>((pageSize + info.texelsPerCell - 1) / info.texelsPerCell)))},
      levels_{static_cast<int>(std::bit_width(static_cast<unsigned>(side_)))},
      first_{build("first level of a shadow pyramid", firstMain)},
      next_{build("level of a shadow pyramid", nextMain)},
      empty_{gl} {
    for (int i = 0; i < levels_; ++i) framebuffers_.emplace_back(gl);
}

gl::Program Pyramid::build(std::string_view label, std::string_view body) const {
    const std::array stages{
        gl::ShaderStage{.type = GL_VERTEX_SHADER, .parts = {cover}},
        gl::ShaderStage{.type = GL_FRAGMENT_SHADER, .parts = {header, info_.glsl, body}}};
    return orThrow(gl::buildProgram(gl_, label, stages));
}

std::uint64_t Pyramid::bytes() const noexcept {
    const auto cells = static_cast<std::uint64_t>(side_) * static_cast<std::uint64_t>(side_);
    return layers_ * cells * 4U / 3U * static_cast<std::uint64_t>(info_.channels) * 4U;
}

void Pyramid::reserve(std::uint64_t layers) {
    gl::Texture larger{gl_, GLenum{GL_TEXTURE_2D_ARRAY}};
    larger.label("shadow pyramid");
    gl_.TextureStorage3D(larger.id(), levels_, info_.channels == 4 ? GL_RGBA32F : GL_RG32F, side_,
                         side_, static_cast<GLsizei>(layers));
    gl_.TextureParameteri(larger.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    gl_.TextureParameteri(larger.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int level = 0; texture_ && level < levels_; ++level)
        gl_.CopyImageSubData(texture_.id(), GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, larger.id(),
                             GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, side_ >> level, side_ >> level,
                             static_cast<GLsizei>(layers_));
    texture_ = std::move(larger);
    layers_ = layers;
}

void Pyramid::make(GLuint pages, int layer) {
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.BindVertexArray(empty_.id());
    gl_.BindSampler(0, 0);
    for (int level = 0; level < levels_; ++level) {
        const GLuint program = level == 0 ? first_.id() : next_.id();
        const GLuint framebuffer = framebuffers_[static_cast<std::size_t>(level)].id();
        gl_.NamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT0, texture_.id(), level,
                                         layer);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl_.Viewport(0, 0, side_ >> level, side_ >> level);
        gl_.UseProgram(program);
        gl_.ProgramUniform1i(program, 0, layer);
        gl_.ProgramUniform1i(program, 1, level);
        gl_.ProgramUniform1f(program, 2, 1.0F / static_cast<float>(pageSize_ + 2));
        gl_.BindTextureUnit(0, level == 0 ? pages : texture_.id());
        if (level > 0) {
            // Only the level before is read while this one is written.
            gl_.TextureParameteri(texture_.id(), GL_TEXTURE_BASE_LEVEL, level - 1);
            gl_.TextureParameteri(texture_.id(), GL_TEXTURE_MAX_LEVEL, level - 1);
        }
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl_.TextureParameteri(texture_.id(), GL_TEXTURE_BASE_LEVEL, 0);
    gl_.TextureParameteri(texture_.id(), GL_TEXTURE_MAX_LEVEL, levels_ - 1);
}

}  // namespace gnomon::shadow
