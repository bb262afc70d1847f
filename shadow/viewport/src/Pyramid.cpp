#include "Pyramid.h"

#include <gnomon/gl/Shader.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace gnomon::shadow {
namespace {

constexpr std::string_view header = R"glsl(#version 450 core
layout(binding = 0) uniform sampler2DArray page;
layout(binding = 1) uniform sampler2D cells;
layout(location = 0) uniform int layer;
layout(location = 1) uniform int level;    // that is made
layout(location = 2) uniform float texel;  // of the page with its border, a share of its side
layout(location = 3) uniform int side;     // cells, of the level
layout(location = 0) out vec4 made;
)glsl";

constexpr std::string_view cover = R"glsl(#version 450 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)glsl";

}  // namespace

gl::Sampler texelSampler(const gl::Api& gl) {
    gl::Sampler sampler{gl};
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
    gl.SamplerParameterfv(sampler.id(), GL_TEXTURE_BORDER_COLOR, nothing.data());
    return sampler;
}

gl::Sampler comparingSampler(const gl::Api& gl) {
    gl::Sampler sampler = texelSampler(gl);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.SamplerParameteri(sampler.id(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    return sampler;
}

GLenum Pyramid::format() const noexcept {
    switch (info_.cell) {
        case Cell::rg16:
            return GL_RG16;
        case Cell::rgba16f:
            return GL_RGBA16F;
        case Cell::rg32f:
            return GL_RG32F;
        case Cell::rgba32f:
            break;
    }
    return GL_RGBA32F;
}

Pyramid::Pyramid(const gl::Api& gl, const PyramidInfo& info, int pageSize)
    : gl_{gl},
      info_{info},
      pageSize_{pageSize},
      side_{static_cast<int>(std::bit_ceil(
          static_cast<unsigned>((pageSize + info.texelsPerCell - 1) / info.texelsPerCell)))},
      levels_{static_cast<int>(std::bit_width(static_cast<unsigned>(side_)))},
      cells_{gl, GLenum{GL_TEXTURE_2D}},
      sampler_{texelSampler(gl)},
      kept_{gl},
      firstLevel_{build("first level of a shadow pyramid", "firstLevel")},
      nextLevel_{build("next level of a shadow pyramid", "nextLevel")},
      keep_{build("kept level of a shadow pyramid", "kept")},
      empty_{gl} {
    cells_.label("cells of a shadow pyramid");
    gl_.TextureStorage2D(cells_.id(), levels_, format(), side_, side_);
    gl_.TextureParameteri(cells_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    gl_.TextureParameteri(cells_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int i = 0; i < levels_; ++i) {
        cell_.emplace_back(gl);
        gl_.NamedFramebufferTexture(cell_.back().id(), GL_COLOR_ATTACHMENT0, cells_.id(), i);
    }
}

gl::Program Pyramid::build(std::string_view label, std::string_view function) const {
    const std::string body =
        "void main() { made = " + std::string{function} + "(ivec2(gl_FragCoord.xy)); }\n";
    const std::array stages{gl::ShaderStage{.type = GL_VERTEX_SHADER, .parts = {cover}},
                            gl::ShaderStage{.type = GL_FRAGMENT_SHADER,
                                            .parts = {header, info_.glsl, info_.levels, body}}};
    return orThrow(gl::buildProgram(gl_, label, stages));
}

std::uint64_t Pyramid::bytes() const noexcept {
    const auto cells = static_cast<std::uint64_t>(side_) * static_cast<std::uint64_t>(side_);
    return layers_ * cells * 4U / 3U * bytesOf(info_.cell);
}

void Pyramid::reserve(std::uint64_t layers) {
    gl::Texture larger{gl_, GLenum{GL_TEXTURE_2D_ARRAY}};
    larger.label("shadow pyramid");
    gl_.TextureStorage3D(larger.id(), levels_, format(), side_, side_,
                         static_cast<GLsizei>(layers));
    gl_.TextureParameteri(larger.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_.TextureParameteri(larger.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TextureParameteri(larger.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
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
    gl_.BindSampler(0, sampler_.id());
    gl_.BindSampler(1, 0);
    gl_.BindTextureUnit(0, pages);
    gl_.BindTextureUnit(1, cells_.id());
    const auto see = [&](int level) {
        gl_.TextureParameteri(cells_.id(), GL_TEXTURE_BASE_LEVEL, level);
        gl_.TextureParameteri(cells_.id(), GL_TEXTURE_MAX_LEVEL, level);
    };
    for (int level = 0; level < levels_; ++level) {
        const auto draw = [&](GLuint program, GLuint framebuffer) {
            gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
            gl_.UseProgram(program);
            gl_.ProgramUniform1i(program, 0, layer);
            gl_.ProgramUniform1i(program, 1, level);
            gl_.ProgramUniform1f(program, 2, 1.0F / static_cast<float>(pageSize_ + 2));
            gl_.ProgramUniform1i(program, 3, side_ >> level);
            gl_.DrawArrays(GL_TRIANGLES, 0, 3);
        };
        gl_.Viewport(0, 0, side_ >> level, side_ >> level);
        // Only the level before is read while a level is written.
        see(std::max(level - 1, 0));
        draw(level == 0 ? firstLevel_.id() : nextLevel_.id(),
             cell_[static_cast<std::size_t>(level)].id());
        see(level);
        gl_.NamedFramebufferTextureLayer(kept_.id(), GL_COLOR_ATTACHMENT0, texture_.id(), level,
                                         layer);
        draw(keep_.id(), kept_.id());
    }
    gl_.BindSampler(0, 0);
}

}  // namespace gnomon::shadow
