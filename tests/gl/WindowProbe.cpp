#include "WindowProbe.h"

#include <fmt/core.h>
#include <gnomon/gl/Handle.h>
#include <gnomon/gl/Window.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

// Last: its macros are many.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>

namespace gnomon::gl {
namespace {

constexpr int width = 64;  // pixels of the window and of the picture in it
constexpr int height = 48;
constexpr int left = 10;  // where the window is on the screen
constexpr int top = 20;

/// "r g b" of a pixel of the screen.
std::string screenPixel(const std::string& screenshot, int x, int y) {
    std::ifstream file{screenshot, std::ios::binary};
    const std::vector<char> bytes{std::istreambuf_iterator<char>{file}, {}};
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(bytes.at(at)); };
    const auto field = [&](std::size_t index) {  // of the XWD header: 32 bits, big-endian
        std::size_t word = 0;
        for (std::size_t i = 0; i < 4; ++i) word = word << 8U | byte(4 * index + i);
        return word;
    };
    constexpr std::size_t colourEntryBytes = 12;
    const auto data = field(0) + field(19) * colourEntryBytes;
    const auto at = data + field(12) * static_cast<std::size_t>(y) +
                    field(11) / 8 * static_cast<std::size_t>(x);
    return fmt::format("{} {} {}", byte(at + 2), byte(at + 1), byte(at));  // stored as BGRX
}

void fill(const Api& gl, const Texture& texture, std::array<std::uint8_t, 4> lower,
          std::array<std::uint8_t, 4> upper) {
    gl.ClearTexSubImage(texture.id(), 0, 0, 0, 0, width, height / 2, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        lower.data());
    gl.ClearTexSubImage(texture.id(), 0, 0, height / 2, 0, width, height / 2, 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, upper.data());
}

/// Another client of the display, as a user or a window manager would be.
class Stranger {
public:
    Stranger() : display_{XOpenDisplay(nullptr)} {
        if (display_ == nullptr) throw Failure{Errc::context, "Xlib cannot open the display"};
        find();
    }
    ~Stranger() { XCloseDisplay(display_); }
    Stranger(const Stranger&) = delete;
    Stranger& operator=(const Stranger&) = delete;

    void press(KeySym key) {
        XEvent event{};
        event.xkey.type = KeyPress;
        event.xkey.time = 1000;  // GLFW takes a press at time 0 for a repetition
        event.xkey.keycode = XKeysymToKeycode(display_, key);
        event.xkey.state = ShiftMask;
        send(event);
    }
    void click(unsigned button, int x, int y) {
        XEvent event{};
        event.xbutton.type = ButtonPress;
        event.xbutton.button = button;
        event.xbutton.x = x;
        event.xbutton.y = y;
        send(event);
    }
    void move(int x, int y) {
        XEvent event{};
        event.xmotion.type = MotionNotify;
        event.xmotion.x = x;
        event.xmotion.y = y;
        send(event);
    }
    void close() {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
        event.xclient.format = 32;
        event.xclient.data.l[0] =
            static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
        send(event);
    }
    void resize(unsigned newWidth, unsigned newHeight) {
        XResizeWindow(display_, window_, newWidth, newHeight);
    }
    /// Returns once the display has done all of the above.
    void sync() { XSync(display_, False); }

private:
    void send(XEvent& event) {
        event.xany.display = display_;
        event.xany.window = window_;
        XSendEvent(display_, window_, False, NoEventMask, &event);
    }
    /// The one visible window.
    void find() {
        ::Window root = 0;
        ::Window parent = 0;
        ::Window* children = nullptr;
        unsigned count = 0;
        XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count);
        for (unsigned i = 0; i < count; ++i) {
            XWindowAttributes attributes{};
            XGetWindowAttributes(display_, children[i], &attributes);
            if (attributes.map_state == IsViewable) window_ = children[i];
        }
        XFree(children);
        if (window_ == 0) throw Failure{Errc::context, "no window is visible"};
    }

    Display* display_ = nullptr;
    ::Window window_ = 0;
};

void reportEvents(Window& window) {
    constexpr std::array names{"key", "button", "motion", "scroll", "close", "resize"};
    for (const auto& event : window.takeEvents())
        fmt::print("event {} code={} action={} mods={} at={},{}\n",
                   names.at(static_cast<std::size_t>(event.kind)), event.code, event.action,
                   event.mods, event.x, event.y);
}

void probePicture(Context& context, Window& window, const std::string& screenshot) {
    const auto& gl = context.api();
    const Texture picture{gl, GL_TEXTURE_2D};
    gl.TextureStorage2D(picture.id(), 1, GL_RGBA8, width, height);
    fill(gl, picture, {10, 20, 30, 255}, {200, 150, 100, 255});
    const auto show = [&](const char* key) {
        orThrow(window.present(picture.id(), width, height));
        // Asking for the size is a round trip: the display has the picture when it returns.
        fmt::print("{}Size {}x{}\n", key, window.widthPixels(), window.heightPixels());
        fmt::print("{}Top {}\n", key, screenPixel(screenshot, left + 1, top + 1));
        fmt::print("{}Bottom {}\n", key, screenPixel(screenshot, left + 1, top + height - 2));
    };
    show("first");
    fill(gl, picture, {1, 2, 3, 255}, {4, 5, 6, 255});  // no finish: present() must wait for it
    show("second");

    const auto nothing = window.present(12345, width, height);
    fmt::print("noTexture {}\n", nothing ? "shown" : nothing.error().text());
    const Texture depth{gl, GL_TEXTURE_2D};
    gl.TextureStorage2D(depth.id(), 1, GL_DEPTH_COMPONENT32F, width, height);
    const auto wrong = window.present(depth.id(), width, height);
    fmt::print("depthTexture {}\n", wrong ? "shown" : wrong.error().text());
}

void probeEvents(Window& window) {
    window.takeEvents();  // what opening it caused
    Stranger stranger;
    stranger.press(XK_a);
    stranger.move(5, 6);
    stranger.click(Button1, 5, 6);
    stranger.move(7, 8);
    stranger.move(9, 10);
    stranger.click(Button4, 9, 10);  // X11's scroll wheel
    stranger.resize(80, 60);
    stranger.close();
    stranger.sync();
    fmt::print("sizeAfter {}\n", window.widthPixels());  // a round trip: the events are here now
    reportEvents(window);
}

}  // namespace

void probeWindows(const std::string& screenshot) {
    const auto context =
        orThrow(createContext({.backend = Backend::glfw, .debug = true, .wantsWindow = true}));
    fmt::print("description {}\n", context->description());
    const auto missing = openWindow(*context, {.monitor = 7});
    fmt::print("noMonitor {}\n", missing ? "opened" : missing.error().text());
    {
        const auto window = orThrow(openWindow(*context, {.width = width,
                                                          .height = height,
                                                          .position = WindowPosition{left, top},
                                                          .decorated = false}));
        window->setSwapInterval(0);
        probePicture(*context, *window, screenshot);
        probeEvents(*window);
    }
    const auto full =
        orThrow(openWindow(*context, {.fullscreen = true, .monitor = 0, .swapGroup = true}));
    fmt::print("swapGroup {}\n", full->swapGroup());
    fmt::print("fullscreen {}x{}\n", full->widthPixels(), full->heightPixels());
    for (const auto& message : context->takeDebugErrors()) fmt::print("debug {}\n", message);
}

}  // namespace gnomon::gl
