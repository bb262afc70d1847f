#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/gl/Handle.h>

#include <glm/vec2.hpp>

namespace gnomon::render {

/// Framebuffers of one window: multisampled where asked, and the resolved picture.
class Target {
public:
    struct Shape {
        glm::ivec2 size{0, 0};
        int samples = 1;
        bool stencil = false;
        friend bool operator==(const Shape&, const Shape&) = default;
    };

    /// Errors (Errc::context): the driver cannot make framebuffers of this size.
    static Result<Target> make(const gl::Api& gl, const Shape& shape);

    const Shape& shape() const noexcept { return shape_; }
    GLuint drawn() const noexcept { return samples_ ? samples_.id() : resolved_.id(); }
    GLuint resolved() const noexcept { return resolved_.id(); }
    GLuint color() const noexcept { return color_.id(); }
    /// Copies multisampled pixels into the picture; nothing without multisampling.
    void resolve(const gl::Api& gl) const;
    /// The depth of what was drawn, as a texture that is not multisampled.
    GLuint depth(const gl::Api& gl) const;
    /// A texture with a copy of the depth, for passes that read it.
    GLuint depthCopy(const gl::Api& gl) const;

private:
    Shape shape_ = {};
    gl::Texture color_;
    gl::Texture depth_;
    gl::Texture copiedDepth_;
    gl::Renderbuffer manyColor_;
    gl::Renderbuffer manyDepth_;
    gl::Framebuffer resolved_;
    gl::Framebuffer samples_;
    gl::Framebuffer copy_;
};

}  // namespace gnomon::render
