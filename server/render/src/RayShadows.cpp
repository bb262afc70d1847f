#include "RayShadows.h"

#include <algorithm>

#include "Glsl.h"

namespace gnomon::render {

RayShadows::RayShadows(const gl::Api& gl) : gl_{gl}, framebuffer_{gl} {
    gl_.NamedFramebufferDrawBuffer(framebuffer_.id(), GL_NONE);
}

bool RayShadows::has(const Pass& pass, std::span<const Light> lights) const {
    // What the lights are is part of the scene's version.
    return pass == last_ && lights.size() == lights_.size() && !lights_.empty() &&
           std::equal(lights.begin(), lights.end(), lights_.begin(),
                      [](const Light& a, const Light& b) { return a.layer == b.layer; });
}

void RayShadows::begin(const Pass& pass, int layers) {
    if (pass.size != size_ || layers > layers_) {
        size_ = pass.size;
        layers_ = layers;
        factors_ = gl::Texture{gl_, GLenum{GL_TEXTURE_2D_ARRAY}};
        factors_.label("ray-traced shadow factors");
        gl_.TextureStorage3D(factors_.id(), 1, GL_R8, size_.x, size_.y, layers_);
        gl_.TextureParameteri(factors_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_.TextureParameteri(factors_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    const glm::ivec2 drawn = glm::ivec2{pass.pixels.width, pass.pixels.height} + 2 * margin;
    if (drawn != drawn_) {
        drawn_ = drawn;
        depth_ = gl::Texture{gl_, GLenum{GL_TEXTURE_2D}};
        depth_.label("depth for rays");
        gl_.TextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, drawn_.x, drawn_.y);
        gl_.NamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Viewport(0, 0, drawn_.x, drawn_.y);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.DepthMask(GL_TRUE);
    const float clear = 0.0F;
    gl_.ClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &clear);
}

void RayShadows::end(const Pass& pass, std::span<const Light> lights,
                     const truth::RayScene& scene) {
    const auto& at = pass.pixels;
    depths_.resize(static_cast<std::size_t>(drawn_.x) * static_cast<std::size_t>(drawn_.y));
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
    gl_.ReadPixels(0, 0, drawn_.x, drawn_.y, GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
    shapes_.clear();
    for (const Light& light : lights) shapes_.push_back(light.shape);
    const auto traced = tracer_.trace(
        scene, {.clipFromWorld = pass.clipFromWorld, .size = drawn_, .depths = depths_}, shapes_);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, drawn_.x);
    for (std::size_t i = 0; i < lights.size(); ++i)
        gl_.TextureSubImage3D(
            factors_.id(), 0, at.x, at.y, lights[i].layer, at.width, at.height, 1, GL_RED,
            GL_UNSIGNED_BYTE,
            traced.data() + i * depths_.size() +
                static_cast<std::size_t>(margin) * static_cast<std::size_t>(drawn_.x + 1));
    gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    last_ = pass;
    lights_.assign(lights.begin(), lights.end());
}

void RayShadows::bind() const {
    gl_.BindTextureUnit(glsl::factorUnit, factors_.id());
    gl_.BindSampler(glsl::factorUnit, 0);
}

}  // namespace gnomon::render
