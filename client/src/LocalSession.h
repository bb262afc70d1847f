#pragma once

#include <gnomon/client/SceneSetup.h>
#include <gnomon/client/WallSetup.h>
#include <gnomon/gl/Context.h>
#include <gnomon/render/Renderer.h>
#include <gnomon/shadow_fit/ShadowFitter.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::client {

/// A wall of one process: the application's aspect, the session's with its fits, and a renderer,
/// joined by the same change lists that go to servers.
class LocalSession {
public:
    /// @param context  current; outlives the session. Several sessions may share one.
    LocalSession(gl::Context& context, std::function<void(std::string)> report);
    ~LocalSession();
    LocalSession(const LocalSession&) = delete;
    LocalSession& operator=(const LocalSession&) = delete;

    field::Aspect& aspect() noexcept { return aspect_; }
    render::Renderer& renderer() noexcept { return *renderer_; }
    /// What the renderer has of a window.
    const scene::Window& rendered(field::Ref<scene::Window> window) const;
    /// Passes on what was edited since the last call. @throws Failure
    void commit();

private:
    static field::TypeRegistry makeTypes();
    void replicate(field::ChangeList changes);

    field::TypeRegistry types_;
    field::Aspect aspect_;
    field::Aspect session_;
    field::Aspect replica_;
    shadow_fit::ShadowFitter fitter_;
    gl::Context& context_;
    std::unique_ptr<render::Renderer> renderer_;
    bool drawn_ = false;  ///< something may have been, since the first commit
};

/// @param backend  as on the command line. @throws Failure Errc::context
std::unique_ptr<gl::Context> makeContext(const std::string& backend);

}  // namespace gnomon::client
