#pragma once

#include <GL/glcorearb.h>
#include <gnomon/base/Error.h>
#include <gnomon/gl/Functions.h>

#include <functional>
#include <string_view>

namespace gnomon::gl {

/// The loaded entry points of one context: `gl.CreateTextures(...)` is `glCreateTextures(...)`.
/// Valid only while that context is current on the calling thread.
struct Api {
// clang-format off
#define GNOMON_GL_MEMBER(name, type) PFNGL##type##PROC name = nullptr;
    GNOMON_GL_FUNCTIONS(GNOMON_GL_MEMBER)
#undef GNOMON_GL_MEMBER
#define GNOMON_GL_MEMBER(name, type, minor, extension, extensionName) \
    PFNGL##type##PROC name = nullptr;  // optional
    GNOMON_GL_OPTIONAL_FUNCTIONS(GNOMON_GL_MEMBER)
#undef GNOMON_GL_MEMBER
    // clang-format on
};

using Procedure = void (*)();
/// The entry point of a name, or null.
using GetProcedure = std::function<Procedure(const char* name)>;

/// Loads every entry point. Errors (Errc::context): a function that is missing, or a context
/// older than OpenGL 4.5.
/// @pre The context to load from is current.
Result<Api> loadApi(const GetProcedure& getProcedure);

/// True if the current context, of which @p gl is the table, lists @p extension.
bool hasExtension(const Api& gl, std::string_view extension);

/// Names an object for debug messages and tools; a longer label than the driver takes is cut.
/// @param identifier  GL_BUFFER, GL_TEXTURE, GL_PROGRAM ...
void setLabel(const Api& gl, GLenum identifier, GLuint id, std::string_view label);

/// Stops a debug build when no context is current on this thread; nothing in a release build.
void expectCurrent(const Api& gl) noexcept;

}  // namespace gnomon::gl
