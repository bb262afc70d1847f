#include <fmt/core.h>

#include <utility>

#include "Glfw.h"

namespace gnomon::gl {

Result<void> startGlfw() {
    const auto display = displayVariables();
    if (!display.any) return fail(Errc::context, "glfw: no display to open: " + display.text);
    if (glfwInit() == GLFW_FALSE)
        return fail(Errc::context, fmt::format("glfw: cannot open the display ({}): {}",
                                               display.text, glfwProblem()));
    return {};
}

std::string glfwProblem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

void setContextHints(bool debug) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    // Nothing is drawn into a window's own buffer but the finished picture.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

GlfwContext::~GlfwContext() {
    doneCurrent();
    glfwDestroyWindow(hidden_);
}

void GlfwContext::makeCurrent() {
    glfwMakeContextCurrent(hidden_);
    if (glfwGetCurrentContext() != hidden_)
        throw Failure{Errc::context, "cannot make the glfw context current: " + glfwProblem()};
}

void GlfwContext::doneCurrent() noexcept {
    if (glfwGetCurrentContext() == hidden_) glfwMakeContextCurrent(nullptr);
}

Result<void> GlfwContext::load() {
    return finish([](const char* name) { return glfwGetProcAddress(name); },
                  "display " + displayVariables().text, debug_);
}

Result<std::unique_ptr<Context>> createGlfw(const ContextOptions& options) {
    if (auto free = checkFamily(Family::system); !free)
        return tl::unexpected{std::move(free).error()};
    if (auto started = startGlfw(); !started) return tl::unexpected{std::move(started).error()};
    setContextHints(options.debug);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* hidden = glfwCreateWindow(8, 8, "Gnomon", nullptr, nullptr);
    if (hidden == nullptr)
        return fail(Errc::context,
                    fmt::format("glfw: cannot make an OpenGL 4.5 core context ({}): {}",
                                displayVariables().text, glfwProblem()));
    auto context = std::make_unique<GlfwContext>(hidden, options.debug);
    if (auto claimed = claimFamily(Family::system); !claimed)
        return tl::unexpected{std::move(claimed).error()};
    try {
        context->makeCurrent();
    } catch (const Failure& failure) {
        return tl::unexpected{failure.error()};
    }
    if (auto loaded = context->load(); !loaded) return tl::unexpected{std::move(loaded).error()};
    return context;
}

}  // namespace gnomon::gl
