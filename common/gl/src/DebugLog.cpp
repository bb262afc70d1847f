#include "DebugLog.h"

#include <fmt/core.h>

#include <utility>

namespace gnomon::gl {
namespace {

constexpr std::size_t maxErrors = 100;  // a broken frame loop must not eat the memory

std::string_view sourceName(GLenum source) {
    switch (source) {
        case GL_DEBUG_SOURCE_API:
            return "api";
        case GL_DEBUG_SOURCE_WINDOW_SYSTEM:
            return "window system";
        case GL_DEBUG_SOURCE_SHADER_COMPILER:
            return "shader compiler";
        case GL_DEBUG_SOURCE_THIRD_PARTY:
            return "third party";
        case GL_DEBUG_SOURCE_APPLICATION:
            return "application";
        default:
            return "other";
    }
}

}  // namespace

void Context::DebugLog::attach(const Api& gl) {
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(&receive, this);
}

std::vector<std::string> Context::DebugLog::take() {
    const std::scoped_lock lock{mutex_};
    if (const auto dropped = std::exchange(dropped_, 0); dropped > 0)
        errors_.push_back(fmt::format("... and {} more", dropped));
    return std::exchange(errors_, {});
}

void APIENTRY Context::DebugLog::receive(GLenum source, GLenum type, GLuint id, GLenum severity,
                                         GLsizei length, const GLchar* message, const void* log) {
    // What the compiler says is in the info log, which buildProgram() returns: there, text that
    // does not compile may be bad input rather than a mistake.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
    // The table hands the pointer back as const; it is the one attach() gave.
    auto& self = *static_cast<DebugLog*>(const_cast<void*>(log));
    std::string_view text =
        length >= 0 ? std::string_view{message, static_cast<std::size_t>(length)} : message;
    while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.remove_suffix(1);
    const std::scoped_lock lock{self.mutex_};
    if (self.errors_.size() >= maxErrors)
        ++self.dropped_;
    else
        self.errors_.push_back(fmt::format("OpenGL {} {}: {}", sourceName(source), id, text));
}

}  // namespace gnomon::gl
