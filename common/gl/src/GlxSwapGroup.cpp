// Apart from the rest, since Xlib's macros are many.
#include "GlxSwapGroup.h"

#include <GL/glx.h>
#include <dlfcn.h>

namespace gnomon::gl {
namespace {

using QueryMost = Bool (*)(Display*, int, GLuint*, GLuint*);
using JoinGroup = Bool (*)(Display*, GLXDrawable, GLuint);
using BindBarrier = Bool (*)(Display*, GLuint, GLuint);

/// Looked up while running: a GLFW that was built for Wayland has it not.
template <class Function>
Function ofGlfw(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
}
template <class Function>
Function ofDriver(const char* name) {
    return reinterpret_cast<Function>(glfwGetProcAddress(name));
}

}  // namespace

SwapGroups glxSwapGroups(GLFWwindow* window) {
    const auto displayOf = ofGlfw<Display* (*)()>("glfwGetX11Display");
    const auto windowOf = ofGlfw<GLXWindow (*)(GLFWwindow*)>("glfwGetGLXWindow");
    if (displayOf == nullptr || windowOf == nullptr ||
        glfwExtensionSupported("GLX_NV_swap_group") == GLFW_FALSE)
        return {};
    Display* display = displayOf();
    const GLXDrawable drawable = windowOf(window);
    const auto most = ofDriver<QueryMost>("glXQueryMaxSwapGroupsNV");
    const auto join = ofDriver<JoinGroup>("glXJoinSwapGroupNV");
    const auto bind = ofDriver<BindBarrier>("glXBindSwapBarrierNV");
    if (display == nullptr || drawable == 0 || most == nullptr || join == nullptr ||
        bind == nullptr)
        return {};
    return {.most =
                [=](unsigned& groups, unsigned& barriers) {
                    return most(display, DefaultScreen(display), &groups, &barriers) != 0;
                },
            .join = [=](unsigned group) { return join(display, drawable, group) != 0; },
            .bind = [=](unsigned group,
                        unsigned barrier) { return bind(display, group, barrier) != 0; }};
}

}  // namespace gnomon::gl
