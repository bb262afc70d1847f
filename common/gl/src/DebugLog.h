#pragma once

#include <gnomon/gl/Context.h>

#include <mutex>
#include <string>
#include <vector>

namespace gnomon::gl {

/// What a debug context complained about. Drivers may report from threads of their own.
class Context::DebugLog {
public:
    /// Makes the current context report here for the rest of its life.
    void attach(const Api& gl);
    std::vector<std::string> take();

private:
    static void APIENTRY receive(GLenum source, GLenum type, GLuint id, GLenum severity,
                                 GLsizei length, const GLchar* message, const void* log);

    std::mutex mutex_;
    std::vector<std::string> errors_;
    std::size_t dropped_ = 0;
};

}  // namespace gnomon::gl
