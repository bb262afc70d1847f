#pragma once

#include <gnomon/gl/Api.h>

#include <string_view>
#include <utility>

namespace gnomon::gl {

/// Sole owner of one OpenGL object name. A default or moved-from handle owns nothing and its
/// id() is 0.
/// @pre The context @p api was loaded from is current wherever a handle is created, assigned to,
///      reset or destroyed (a debug build stops otherwise); @p api outlives the handle.
template <class Kind>
class Handle {
public:
    Handle() noexcept = default;
    /// Creates an object of a kind that needs nothing else.
    explicit Handle(const Api& api) : api_{&api}, id_{Kind::create(api)} {}
    /// Creates an object of a kind that needs a target or a shader type.
    Handle(const Api& api, GLenum type) : api_{&api}, id_{Kind::create(api, type)} {}
    ~Handle() { reset(); }

    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&& other) noexcept : api_{other.api_}, id_{other.release()} {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            api_ = other.api_;
            id_ = other.release();
        }
        return *this;
    }

    GLuint id() const noexcept { return id_; }
    explicit operator bool() const noexcept { return id_ != 0; }

    /// Names the object for debug messages and tools.
    void label(std::string_view text) const {
        GNOMON_EXPECTS(id_ != 0, "an empty handle has nothing to label");
        setLabel(*api_, Kind::identifier, id_, text);
    }

    /// Gives up ownership: the caller deletes the object.
    [[nodiscard]] GLuint release() noexcept { return std::exchange(id_, 0U); }
    void reset() noexcept {
        if (id_ == 0) return;
        expectCurrent(*api_);
        Kind::destroy(*api_, release());
    }

private:
    const Api* api_ = nullptr;
    GLuint id_ = 0;
};

struct BufferKind {
    static constexpr GLenum identifier = GL_BUFFER;
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct TextureKind {
    static constexpr GLenum identifier = GL_TEXTURE;
    static GLuint create(const Api& gl, GLenum target);
    /// A bare name without a target: what TextureView wants.
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct SamplerKind {
    static constexpr GLenum identifier = GL_SAMPLER;
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct FramebufferKind {
    static constexpr GLenum identifier = GL_FRAMEBUFFER;
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct RenderbufferKind {
    static constexpr GLenum identifier = GL_RENDERBUFFER;
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct VertexArrayKind {
    static constexpr GLenum identifier = GL_VERTEX_ARRAY;
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct ProgramKind {
    static constexpr GLenum identifier = GL_PROGRAM;
    static GLuint create(const Api& gl);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct ShaderKind {
    static constexpr GLenum identifier = GL_SHADER;
    static GLuint create(const Api& gl, GLenum type);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

struct QueryKind {
    static constexpr GLenum identifier = GL_QUERY;
    static GLuint create(const Api& gl, GLenum target);
    static void destroy(const Api& gl, GLuint id) noexcept;
};

using Buffer = Handle<BufferKind>;
using Texture = Handle<TextureKind>;
using Sampler = Handle<SamplerKind>;
using Framebuffer = Handle<FramebufferKind>;
using Renderbuffer = Handle<RenderbufferKind>;
using VertexArray = Handle<VertexArrayKind>;
using Program = Handle<ProgramKind>;
using Shader = Handle<ShaderKind>;
using Query = Handle<QueryKind>;

}  // namespace gnomon::gl
