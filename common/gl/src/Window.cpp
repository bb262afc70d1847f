#include <fmt/core.h>
#include <gnomon/gl/Handle.h>
#include <gnomon/gl/Window.h>

#include <utility>

#include "Glfw.h"
#include "GlxSwapGroup.h"

namespace gnomon::gl {
namespace {

class GlfwWindow final : public Window {
public:
    GlfwWindow(GlfwContext& context, GLFWwindow* window) : context_{context}, window_{window} {}
    ~GlfwWindow() override {
        glfwMakeContextCurrent(window_);
        readFrom_.reset();
        glfwDestroyWindow(window_);
        glfwMakeContextCurrent(context_.hidden());
    }
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    Result<void> load(bool swapGroup);
    void listen();

    Result<void> present(GLuint texture, int width, int height) override;
    void setSwapInterval(int refreshes) override {
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(refreshes);
        context_.makeCurrent();
    }
    std::vector<InputEvent> takeEvents() override {
        glfwPollEvents();
        return std::exchange(events_, {});
    }
    const std::string& swapGroup() const override { return swapGroup_; }
    int widthPixels() const override { return sizePixels().first; }
    int heightPixels() const override { return sizePixels().second; }

private:
    std::pair<int, int> sizePixels() const {
        std::pair<int, int> size;
        glfwGetFramebufferSize(window_, &size.first, &size.second);
        return size;
    }
    static GlfwWindow& of(GLFWwindow* window) {
        return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
    }
    Result<void> blit(GLuint texture, int width, int height);

    GlfwContext& context_;
    GLFWwindow* window_ = nullptr;
    Api api_ = {};  // of the window's own context
    Framebuffer readFrom_ = {};
    std::string swapGroup_ = {};
    std::vector<InputEvent> events_ = {};
    // As of the last motion, not as of now: a click belongs to where the cursor was at the time.
    double cursorX_ = 0;
    double cursorY_ = 0;
};

Result<void> GlfwWindow::load(bool swapGroup) {
    glfwMakeContextCurrent(window_);
    auto loaded = loadApi([](const char* name) { return glfwGetProcAddress(name); });
    if (!loaded) {
        context_.makeCurrent();
        return tl::unexpected{std::move(loaded).error()};
    }
    api_ = *std::move(loaded);
    readFrom_ = Framebuffer{api_};
    readFrom_.label("window source");
    if (swapGroup) swapGroup_ = joinSwapGroup(glxSwapGroups(window_)).text;
    context_.makeCurrent();
    return {};
}

void GlfwWindow::listen() {
    using Kind = InputEvent::Kind;
    glfwSetWindowUserPointer(window_, this);
    glfwGetCursorPos(window_, &cursorX_, &cursorY_);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
        of(w).events_.push_back({.kind = Kind::key, .code = key, .action = action, .mods = mods});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
        auto& self = of(w);
        self.events_.push_back({.kind = Kind::button,
                                .code = button,
                                .action = action,
                                .mods = mods,
                                .x = self.cursorX_,
                                .y = self.cursorY_});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        auto& self = of(w);
        auto& events = self.events_;
        // A slow reader must not pile up a mouse's thousand reports a second.
        if (!events.empty() && events.back().kind == Kind::motion) events.pop_back();
        events.push_back({.kind = Kind::motion, .x = x, .y = y});
        self.cursorX_ = x;
        self.cursorY_ = y;
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
        of(w).events_.push_back({.kind = Kind::scroll, .x = x, .y = y});
    });
    glfwSetWindowCloseCallback(
        window_, [](GLFWwindow* w) { of(w).events_.push_back({.kind = Kind::close}); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int width, int height) {
        of(w).events_.push_back({.kind = Kind::resize,
                                 .x = static_cast<double>(width),
                                 .y = static_cast<double>(height)});
    });
}

Result<void> GlfwWindow::present(GLuint texture, int width, int height) {
    context_.makeCurrent();
    const auto& producer = context_.api();
    GLsync drawn = producer.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    producer.Flush();  // else the fence may never reach the GPU that the window waits on
    glfwMakeContextCurrent(window_);
    api_.WaitSync(drawn, 0, GL_TIMEOUT_IGNORED);
    api_.DeleteSync(drawn);
    auto shown = blit(texture, width, height);
    if (shown) glfwSwapBuffers(window_);
    context_.makeCurrent();
    return shown;
}

Result<void> GlfwWindow::blit(GLuint texture, int width, int height) {
    if (api_.IsTexture(texture) == GL_FALSE)
        return fail(Errc::context, fmt::format("window: there is no texture {}", texture));
    api_.NamedFramebufferTexture(readFrom_.id(), GL_COLOR_ATTACHMENT0, texture, 0);
    const auto status = api_.CheckNamedFramebufferStatus(readFrom_.id(), GL_READ_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return fail(Errc::context,
                    fmt::format("window: texture {} cannot be shown: framebuffer status {:#x}, a "
                                "2D colour texture is needed",
                                texture, status));
    const auto [windowWidth, windowHeight] = sizePixels();
    const bool same = windowWidth == width && windowHeight == height;
    api_.BlitNamedFramebuffer(readFrom_.id(), 0, 0, 0, width, height, 0, 0, windowWidth,
                              windowHeight, GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
    // Attached again each time: the name may stand for another texture by then.
    api_.NamedFramebufferTexture(readFrom_.id(), GL_COLOR_ATTACHMENT0, 0, 0);
    return {};
}

struct Place {
    GLFWmonitor* monitor = nullptr;  // full screen on it
    int width = 0;
    int height = 0;
    std::optional<WindowPosition> position = {};
};

std::string listed(GLFWmonitor* const* monitors, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        int x = 0;
        int y = 0;
        glfwGetMonitorPos(monitors[i], &x, &y);
        const auto* mode = glfwGetVideoMode(monitors[i]);
        text += fmt::format("{}{}: {} {}x{} at {},{}", i == 0 ? "" : "; ", i,
                            glfwGetMonitorName(monitors[i]), mode != nullptr ? mode->width : 0,
                            mode != nullptr ? mode->height : 0, x, y);
    }
    return text.empty() ? "none" : text;
}

Result<Place> placeFor(const WindowOptions& options) {
    Place place{.width = options.width, .height = options.height, .position = options.position};
    if (options.monitor < 0 && !options.fullscreen) return place;

    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    if (options.monitor >= count)
        return fail(Errc::context,
                    fmt::format("window \"{}\": there is no monitor {}; monitors "
                                "found: {}",
                                options.title, options.monitor, listed(monitors, count)));
    GLFWmonitor* monitor =
        options.monitor < 0 ? glfwGetPrimaryMonitor() : monitors[options.monitor];
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr)
        return fail(Errc::context,
                    fmt::format("window \"{}\": full screen needs a monitor; monitors found: {}",
                                options.title, listed(monitors, count)));
    if (options.fullscreen) {
        // The mode it is in: changing it would rearrange the desktop.
        glfwWindowHint(GLFW_RED_BITS, mode->redBits);
        glfwWindowHint(GLFW_GREEN_BITS, mode->greenBits);
        glfwWindowHint(GLFW_BLUE_BITS, mode->blueBits);
        glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
        return Place{.monitor = monitor, .width = mode->width, .height = mode->height};
    }
    int x = 0;
    int y = 0;
    glfwGetMonitorPos(monitor, &x, &y);
    const auto offset = options.position.value_or(WindowPosition{});
    place.position = WindowPosition{.x = x + offset.x, .y = y + offset.y};
    return place;
}

}  // namespace

Result<std::unique_ptr<Window>> openWindow(Context& context, const WindowOptions& options) {
    auto* glfw = dynamic_cast<GlfwContext*>(&context);
    if (glfw == nullptr)
        return fail(Errc::context, fmt::format("window \"{}\": the {} back end shows no windows, "
                                               "only glfw does",
                                               options.title, name(context.backend())));
    if (!options.fullscreen && (options.width < 1 || options.height < 1))
        return fail(Errc::context, fmt::format("window \"{}\": size is {}x{}, must be at least 1x1",
                                               options.title, options.width, options.height));
    setContextHints(glfw->debug());
    auto place = placeFor(options);
    if (!place) return tl::unexpected{std::move(place).error()};
    glfwWindowHint(GLFW_DECORATED, options.decorated ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // a wall's windows stay when focus leaves
    // Placed before it is seen. Full-screen windows ignore the hint.
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* handle = glfwCreateWindow(place->width, place->height, options.title.c_str(),
                                          place->monitor, glfw->hidden());
    if (handle == nullptr)
        return fail(Errc::context, fmt::format("window \"{}\" ({}x{}): {}", options.title,
                                               place->width, place->height, glfwProblem()));
    auto window = std::make_unique<GlfwWindow>(*glfw, handle);
    if (auto loaded = window->load(options.swapGroup); !loaded)
        return tl::unexpected{std::move(loaded).error()};
    window->listen();
    if (!options.cursorVisible) glfwSetInputMode(handle, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    if (place->position) glfwSetWindowPos(handle, place->position->x, place->position->y);
    if (place->monitor == nullptr) glfwShowWindow(handle);
    return window;
}

}  // namespace gnomon::gl
