#include <gnomon/gl/Handle.h>

namespace gnomon::gl {
namespace {

/// The one name that a glCreate* function of the form (count, names) makes.
template <class Create>
GLuint one(Create create) {
    GLuint id = 0;
    create(1, &id);
    return id;
}

template <class Create>
GLuint one(Create create, GLenum target) {
    GLuint id = 0;
    create(target, 1, &id);
    return id;
}

}  // namespace

GLuint BufferKind::create(const Api& gl) { return one(gl.CreateBuffers); }
void BufferKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteBuffers(1, &id); }

GLuint TextureKind::create(const Api& gl, GLenum target) { return one(gl.CreateTextures, target); }
GLuint TextureKind::create(const Api& gl) { return one(gl.GenTextures); }
void TextureKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteTextures(1, &id); }

GLuint SamplerKind::create(const Api& gl) { return one(gl.CreateSamplers); }
void SamplerKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteSamplers(1, &id); }

GLuint FramebufferKind::create(const Api& gl) { return one(gl.CreateFramebuffers); }
void FramebufferKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteFramebuffers(1, &id); }

GLuint RenderbufferKind::create(const Api& gl) { return one(gl.CreateRenderbuffers); }
void RenderbufferKind::destroy(const Api& gl, GLuint id) noexcept {
    gl.DeleteRenderbuffers(1, &id);
}

GLuint VertexArrayKind::create(const Api& gl) { return one(gl.CreateVertexArrays); }
void VertexArrayKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteVertexArrays(1, &id); }

GLuint QueryKind::create(const Api& gl, GLenum target) { return one(gl.CreateQueries, target); }
void QueryKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteQueries(1, &id); }

GLuint ProgramKind::create(const Api& gl) { return gl.CreateProgram(); }
void ProgramKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteProgram(id); }

GLuint ShaderKind::create(const Api& gl, GLenum type) { return gl.CreateShader(type); }
void ShaderKind::destroy(const Api& gl, GLuint id) noexcept { gl.DeleteShader(id); }

}  // namespace gnomon::gl
