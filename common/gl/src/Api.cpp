#include <fmt/core.h>
#include <gnomon/gl/Api.h>

#include <algorithm>

namespace gnomon::gl {
namespace {

constexpr GLint requiredMajor = 4;
constexpr GLint requiredMinor = 5;

template <class Function>
bool load(const GetProcedure& getProcedure, const char* name, Function& function) {
    function = reinterpret_cast<Function>(getProcedure(name));
    return function != nullptr;
}

}  // namespace

Result<Api> loadApi(const GetProcedure& getProcedure) {
    Api gl;
    const auto missing = [](std::string_view name) {
        return fail(Errc::context,
                    fmt::format("loading OpenGL: the driver has no gl{}, which OpenGL {}.{} needs",
                                name, requiredMajor, requiredMinor));
    };
// clang-format off
#define GNOMON_GL_LOAD(name, type) \
    if (!load(getProcedure, "gl" #name, gl.name)) return missing(#name);
    GNOMON_GL_FUNCTIONS(GNOMON_GL_LOAD)
#undef GNOMON_GL_LOAD
    // clang-format on

    GLint major = 0;
    GLint minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    const auto isAtLeast = [&](GLint wantedMinor) {
        return major > requiredMajor || (major == requiredMajor && minor >= wantedMinor);
    };
    if (!isAtLeast(requiredMinor))
        return fail(Errc::context, fmt::format("loading OpenGL: the context is {}.{}, {}.{} or "
                                               "later is needed",
                                               major, minor, requiredMajor, requiredMinor));

// clang-format off
#define GNOMON_GL_LOAD(name, type, coreMinor, extension, extensionName)             \
    if (const char* from = (coreMinor) > 0 && isAtLeast(coreMinor) ? "gl" #name     \
                           : hasExtension(gl, extension)           ? (extensionName) \
                                                                   : nullptr)       \
        load(getProcedure, from, gl.name);
    GNOMON_GL_OPTIONAL_FUNCTIONS(GNOMON_GL_LOAD)
#undef GNOMON_GL_LOAD
    // clang-format on
    return gl;
}

bool hasExtension(const Api& gl, std::string_view extension) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const auto* name = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (name != nullptr && extension == reinterpret_cast<const char*>(name)) return true;
    }
    return false;
}

void setLabel(const Api& gl, GLenum identifier, GLuint id, std::string_view label) {
    GLint limit = 0;  // counts the terminating zero
    gl.GetIntegerv(GL_MAX_LABEL_LENGTH, &limit);
    const auto length = std::min(static_cast<GLsizei>(label.size()), std::max(limit - 1, 0));
    gl.ObjectLabel(identifier, id, length, label.data());
}

void expectCurrent([[maybe_unused]] const Api& gl) noexcept {
#ifndef NDEBUG
    // Without a current context every entry point is a no-op that returns zero.
    GNOMON_EXPECTS(gl.GetString(GL_VERSION) != nullptr,
                   "an OpenGL object dies while its context is not current");
#endif
}

}  // namespace gnomon::gl
