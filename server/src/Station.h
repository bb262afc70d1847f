#pragma once

#include <gnomon/gl/Context.h>
#include <gnomon/gl/Window.h>
#include <gnomon/render/Renderer.h>

#include <map>
#include <memory>
#include <vector>

namespace gnomon::server {

/// One GPU of this server: a context, the renderer in it, and its windows on a display, if any.
class Station {
public:
    /// @throws Failure Errc::context
    Station(gl::Backend backend, int gpu, bool wantsWindow);
    ~Station();
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;

    const gl::Context& context() const noexcept { return *context_; }
    /// Starts over with another scene; the pictures that are shown stay.
    void attach(const field::Aspect& scene, std::function<void(std::string)> report);
    void update(const field::Applied& applied);
    bool animates() const noexcept { return renderer_ && renderer_->animates(); }

    /// Draws and waits until it is done.
    Result<render::FrameStatistics> draw(const scene::Window& window, double time);
    Result<std::optional<shadow_fit::DepthSpan>> depthSpan(const scene::Window& window, bool drawn);
    image::Image read(const scene::Window& window);
    /// Shows what was drawn; nothing without a display.
    Result<void> present(const scene::Window& window);

    struct Event {
        field::Id window = {};
        gl::InputEvent event = {};
    };
    std::vector<Event> takeEvents();
    bool hasDisplay() const noexcept { return context_->backend() == gl::Backend::glfw; }

private:
    Result<gl::Window*> windowOf(const scene::Window& window);

    struct Shown {
        std::unique_ptr<gl::Window> window = {};
        std::vector<std::byte> shape = {};  ///< what it was opened as
    };
    std::unique_ptr<gl::Context> context_;
    std::function<void(std::string)> report_;
    std::unique_ptr<render::Renderer> renderer_;
    std::map<field::Id, Shown> windows_;
};

}  // namespace gnomon::server
