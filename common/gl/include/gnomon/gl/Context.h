#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/gl/Api.h>
#include <gnomon/gl/Fwd.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::gl {

/// Where a context comes from.
enum class Backend : unsigned char {
    egl,        ///< a GPU or Mesa's software renderer, without any display
    osmesa,     ///< Mesa's software renderer in memory, without any driver
    glfw,       ///< a display; the only one that can show windows
    automatic,  ///< the first that works; Context::description() says why
};

/// The word used in configurations and on the command line: egl, osmesa, glfw, auto.
std::string_view name(Backend backend) noexcept;
/// The reverse. Errc::config names the words there are.
Result<Backend> parseBackend(std::string_view word);

struct ContextOptions {
    Backend backend = Backend::automatic;
    /// EGL device to render on, counted as the system lists them; -1: the system's default.
    /// Only egl can choose; other back ends refuse a number.
    int gpu = -1;
    bool debug = false;  ///< collect debug messages, see Context::takeDebugErrors()
    /// A window will be opened. `automatic` then prefers glfw where there is a display.
    bool wantsWindow = false;
};

/// An OpenGL 4.5 core context that needs no window. Its own framebuffer 0 is not to be used.
/// Belongs to one thread at a time. Everything made in it dies before it, with it current.
class Context {
public:
    virtual ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes this the calling thread's context. @throws Failure (Errc::context).
    virtual void makeCurrent() = 0;
    /// Leaves the calling thread without a context, so that another may take this one.
    virtual void doneCurrent() noexcept = 0;

    const Api& api() const noexcept { return api_; }
    Backend backend() const noexcept { return backend_; }  ///< never `automatic`
    /// GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const noexcept { return renderer_; }
    /// One line: back end, device, renderer, version; for `automatic` also why this one.
    const std::string& description() const noexcept { return description_; }

    /// The debug messages of type error or of high severity since the last call, each with its
    /// source; not the shader compiler's, which buildProgram() returns. Empty without
    /// ContextOptions::debug. Any thread.
    std::vector<std::string> takeDebugErrors();

protected:
    explicit Context(Backend backend);

    /// Loads the entry points, fills in what describes the context and turns debug output on.
    /// @pre This context is current.
    Result<void> finish(const GetProcedure& getProcedure, std::string_view device, bool debug);

private:
    friend Result<std::unique_ptr<Context>> createContext(const ContextOptions& options);
    class DebugLog;

    Api api_ = {};
    Backend backend_ = Backend::automatic;
    std::string renderer_ = {};
    std::string description_ = {};
    std::unique_ptr<DebugLog> debugLog_;
};

/// Makes a context and makes it current on the calling thread.
///
/// EGL and OSMesa share Mesa's dispatch table within a process, so that calls meant for one land
/// in the other: once a context of one of them was made, the other is refused for the life of
/// the process (glfw counts as egl).
///
/// Errors (Errc::context): no such back end on this machine, no OpenGL 4.5 core, no display,
/// no such GPU (the GPUs found are listed), the other family in use.
Result<std::unique_ptr<Context>> createContext(const ContextOptions& options);

}  // namespace gnomon::gl
