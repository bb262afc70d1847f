#pragma once

#include <gnomon/gl/Context.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::gl {

/// Pixels from the top left corner, y down.
struct WindowPosition {
    int x = 0;
    int y = 0;
};

struct WindowOptions {
    std::string title = "Gnomon";
    int width = 1280;  ///< screen units; not used in full screen
    int height = 720;
    bool fullscreen = false;  ///< covers the monitor in the mode it is in
    /// As the system counts monitors; -1: the primary one for full screen, else none in particular.
    int monitor = -1;
    /// On the monitor if one is given, else on the desktop; empty: the window manager decides, or
    /// the corner of the monitor if one is given. Not used in full screen.
    std::optional<WindowPosition> position = {};
    bool decorated = true;
    bool cursorVisible = true;
    /// Shall swap at one refresh with the other windows of the wall that want to, where the driver
    /// can (GLX_NV_swap_group). A window that does not swap then holds up all others.
    bool swapGroup = false;
};

struct InputEvent {
    enum class Kind : unsigned char { key, button, motion, scroll, close, resize };
    Kind kind = Kind::key;
    int code = 0;    ///< key: GLFW_KEY_*, which is ASCII for letters and digits; button: from 0
    int action = 0;  ///< key, button: 0 released, 1 pressed, 2 repeated
    int mods = 0;    ///< key, button: 1 shift, 2 control, 4 alt, 8 super
    /// button, motion: where, screen units from the top left of the window; scroll: by how much;
    /// resize: the new size in pixels.
    double x = 0;
    double y = 0;
};

/// A visible window that shares objects with the glfw context it was made from. It belongs to the
/// main thread, and dies before the context.
class Window {
public:
    virtual ~Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Shows level 0 of a 2D colour texture of the context, @p width x @p height texels, scaled to
    /// the window, and swaps; returns after the swap, with the context current again.
    /// Waits on the GPU for what the context has submitted so far.
    /// Errors (Errc::context): no such texture, or it is not a colour texture.
    virtual Result<void> present(GLuint texture, int width, int height) = 0;

    /// Screen refreshes a swap waits for; 0: none.
    virtual void setSwapInterval(int refreshes) = 0;

    /// What happened in the window since the last call, oldest first. Motions without anything
    /// between them are one event. Never blocks.
    virtual std::vector<InputEvent> takeEvents() = 0;

    /// What it swaps with, or why with nothing; empty where that was not asked for.
    virtual const std::string& swapGroup() const = 0;

    virtual int widthPixels() const = 0;
    virtual int heightPixels() const = 0;

protected:
    Window() = default;
};

/// Opens a window. Errors (Errc::context): @p context is not a glfw one, no such monitor (those
/// there are are listed), the display refuses. Leaves @p context current.
Result<std::unique_ptr<Window>> openWindow(Context& context, const WindowOptions& options);

}  // namespace gnomon::gl
