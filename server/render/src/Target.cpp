#include "Target.h"

#include <algorithm>
#include <string>

namespace gnomon::render {
namespace {

GLenum depthFormat(bool stencil) { return stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F; }
GLenum depthAttachment(bool stencil) {
    return stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

gl::Texture texture(const gl::Api& gl, GLenum format, glm::ivec2 size, const char* label) {
    gl::Texture made{gl, GLenum{GL_TEXTURE_2D}};
    made.label(label);
    gl.TextureStorage2D(made.id(), 1, format, size.x, size.y);
    gl.TextureParameteri(made.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(made.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return made;
}

}  // namespace

Result<Target> Target::make(const gl::Api& gl, const Shape& shape) {
    const auto text = std::to_string(shape.size.x) + "x" + std::to_string(shape.size.y);
    GLint largest = 0;
    GLint mostSamples = 1;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    gl.GetIntegerv(GL_MAX_SAMPLES, &mostSamples);
    if (shape.size.x <= 0 || shape.size.y <= 0 || shape.size.x > largest || shape.size.y > largest)
        return fail(Errc::context, "a window of " + text + " pixels, must be within 1x1 and " +
                                       std::to_string(largest) + "x" + std::to_string(largest));
    Target target;
    target.shape_ = shape;
    target.color_ = texture(gl, GL_SRGB8_ALPHA8, shape.size, "window");
    target.depth_ = texture(gl, depthFormat(shape.stencil), shape.size, "window depth");
    target.resolved_ = gl::Framebuffer{gl};
    target.resolved_.label("window");
    gl.NamedFramebufferTexture(target.resolved_.id(), GL_COLOR_ATTACHMENT0, target.color_.id(), 0);
    gl.NamedFramebufferTexture(target.resolved_.id(), depthAttachment(shape.stencil),
                               target.depth_.id(), 0);
    if (shape.samples > 1) {
        const int samples = std::min(shape.samples, mostSamples);
        target.manyColor_ = gl::Renderbuffer{gl};
        target.manyDepth_ = gl::Renderbuffer{gl};
        gl.NamedRenderbufferStorageMultisample(target.manyColor_.id(), samples, GL_SRGB8_ALPHA8,
                                               shape.size.x, shape.size.y);
        gl.NamedRenderbufferStorageMultisample(target.manyDepth_.id(), samples,
                                               depthFormat(shape.stencil), shape.size.x,
                                               shape.size.y);
        target.samples_ = gl::Framebuffer{gl};
        target.samples_.label("window, multisampled");
        gl.NamedFramebufferRenderbuffer(target.samples_.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                        target.manyColor_.id());
        gl.NamedFramebufferRenderbuffer(target.samples_.id(), depthAttachment(shape.stencil),
                                        GL_RENDERBUFFER, target.manyDepth_.id());
    }
    if (shape.stencil) {
        target.copiedDepth_ = texture(gl, depthFormat(true), shape.size, "window depth, copied");
        gl.TextureParameteri(target.copiedDepth_.id(), GL_DEPTH_STENCIL_TEXTURE_MODE,
                             GL_DEPTH_COMPONENT);
        target.copy_ = gl::Framebuffer{gl};
        gl.NamedFramebufferDrawBuffer(target.copy_.id(), GL_NONE);
        gl.NamedFramebufferTexture(target.copy_.id(), GL_DEPTH_STENCIL_ATTACHMENT,
                                   target.copiedDepth_.id(), 0);
    }
    for (const GLuint id : {target.resolved_.id(), target.samples_ ? target.samples_.id() : 0U}) {
        if (id != 0 &&
            gl.CheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            return fail(Errc::context, "the driver cannot make a framebuffer of " + text +
                                           " pixels with " + std::to_string(shape.samples) +
                                           " samples");
    }
    return target;
}

void Target::resolve(const gl::Api& gl) const {
    if (!samples_) return;
    gl.BlitNamedFramebuffer(samples_.id(), resolved_.id(), 0, 0, shape_.size.x, shape_.size.y, 0, 0,
                            shape_.size.x, shape_.size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

GLuint Target::depth(const gl::Api& gl) const {
    if (samples_)
        gl.BlitNamedFramebuffer(samples_.id(), resolved_.id(), 0, 0, shape_.size.x, shape_.size.y,
                                0, 0, shape_.size.x, shape_.size.y, GL_DEPTH_BUFFER_BIT,
                                GL_NEAREST);
    return depth_.id();
}

GLuint Target::depthCopy(const gl::Api& gl) const {
    gl.BlitNamedFramebuffer(drawn(), copy_.id(), 0, 0, shape_.size.x, shape_.size.y, 0, 0,
                            shape_.size.x, shape_.size.y,
                            GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_NEAREST);
    return copiedDepth_.id();
}

}  // namespace gnomon::render
