#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "Backends.h"

namespace gnomon::gl {

/// Starts GLFW if it is not running. It is never stopped: that would close the windows of others,
/// and the display server cleans up after a process that ends.
Result<void> startGlfw();

/// What GLFW last complained about on this thread, and forgets it.
std::string glfwProblem();

/// The hints common to every window here: OpenGL 4.5 core. Hints are global in GLFW, so each
/// creation sets all of them.
void setContextHints(bool debug);

/// The hidden window whose context is the Context; its windows share objects with it.
class GlfwContext final : public Context {
public:
    GlfwContext(GLFWwindow* hidden, bool debug)
        : Context{Backend::glfw}, hidden_{hidden}, debug_{debug} {}
    ~GlfwContext() override;
    GlfwContext(const GlfwContext&) = delete;
    GlfwContext& operator=(const GlfwContext&) = delete;

    void makeCurrent() override;
    void doneCurrent() noexcept override;
    Result<void> load();

    GLFWwindow* hidden() const noexcept { return hidden_; }
    bool debug() const noexcept { return debug_; }

private:
    GLFWwindow* hidden_ = nullptr;
    bool debug_ = false;
};

}  // namespace gnomon::gl
