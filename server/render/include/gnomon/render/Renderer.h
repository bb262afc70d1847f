#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/gl/Context.h>
#include <gnomon/image/Image.h>
#include <gnomon/scene/Window.h>
#include <gnomon/shadow_fit/Receivers.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::render {

/// What drawing a window took. Counts do not depend on the machine's mood.
struct FrameStatistics {
    std::uint64_t triangles = 0;  ///< colour passes
    std::uint64_t chunks = 0;
    std::uint64_t chunksCulled = 0;
    std::uint64_t shadowTriangles = 0;
    std::uint64_t pagesDrawn = 0;
    std::uint64_t pagesKept = 0;
    std::uint64_t pagesUnseen = 0;
    std::uint64_t mapTexels = 0;  ///< drawn this frame
    std::uint64_t mapBytes = 0;   ///< held
    /// Of filters that blur on the screen: pixels whose factor was found this frame, with margins;
    /// memory held; and how wide a kernel's half may be at the most, pixels.
    std::uint64_t factorPixels = 0;
    std::uint64_t factorBytes = 0;
    int kernelPixels = 0;
    int lights = 0;
    int lightsUnseen = 0;   ///< reach nothing that is seen
    int lightsLeftOut = 0;  ///< more than a view can have
    int degenerate = 0;     ///< fits that fell back to the plain one
    /// Only with measurePasses: each ends with glFinish.
    double shadowMs = 0.0;
    double colorMs = 0.0;
    double overlayMs = 0.0;
};

/// Draws the windows of a replicated scene with one context. Owns everything it makes there and
/// must die before the context, with it current. Nothing is allocated, compiled or looked up by
/// name in a frame that does not need it.
class Renderer {
public:
    /// @param report  told once of each thing that cannot be drawn as asked.
    Renderer(gl::Context& context, const field::Aspect& scene,
             std::function<void(std::string)> report = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Takes in what a change list did; before the next draw().
    void update(const field::Applied& applied);
    /// Forgets every shadow page, so that the next frame draws them anew.
    void forgetShadows();
    /// glFinish after each pass, for pass times.
    void measurePasses(bool on) noexcept;
    /// True when the picture may differ from the last one though no container changed (a shader
    /// that reads the time).
    bool animates() const noexcept;

    /// Draws all viewports of a window into its own framebuffer.
    /// Errors: a viewport without a usable camera (Errc::edit), no memory for it (Errc::context).
    Result<FrameStatistics> draw(const scene::Window& window, double time);
    /// Depths in eye space, metres, between which the window's viewports show something that fits
    /// with DepthUse other than off want to know of; nothing where nothing is seen, or none does.
    /// @param drawn  as the last draw() left it; else depth alone is drawn first
    /// Errors: as draw().
    Result<std::optional<shadow_fit::DepthSpan>> depthSpan(const scene::Window& window, bool drawn);
    /// Of all windows of the scene together.
    Result<std::optional<shadow_fit::DepthSpan>> depthSpan(bool drawn);
    /// Waits until everything drawn is done.
    void finish() const;

    /// The window's picture as of the last draw(): an sRGB 2D texture, bottom row first.
    unsigned colorTexture(const scene::Window& window) const;
    /// RGB, sRGB; empty before the first draw().
    image::Image read(const scene::Window& window);
    /// One light's shadow factor as seen by a viewport: 255 lit, 0 shadowed or facing away, 128 no
    /// surface. One channel. @param light  the node whose core is the light.
    /// Errors (Errc::config): no such viewport, no such light in its scene.
    Result<image::Image> shadowFactor(const scene::Window& window, std::size_t viewport,
                                      scene::Ref<scene::Node> light);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace gnomon::render
