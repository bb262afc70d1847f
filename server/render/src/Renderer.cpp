#include <fmt/format.h>
#include <gnomon/render/Renderer.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/shadow/Filter.h>
#include <gnomon/shadow/ShadowMaps.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "DepthReducer.h"
#include "Lights.h"
#include "Overlay.h"
#include "RayShadows.h"
#include "SceneDrawer.h"
#include "ScreenBlur.h"
#include "Target.h"

namespace gnomon::render {
namespace {

using Clock = std::chrono::steady_clock;

/// What a view without shadows is drawn relative to; ShadowState::origin otherwise.
math::dvec3 originFor(const math::View& view) { return glm::round(view.eyeWorld() / 32.0) * 32.0; }

math::mat4 clipFromOrigin(const math::View& view, const math::dvec3& origin) {
    math::dmat4 shift{1.0};
    shift[3] = math::dvec4{origin, 1.0};
    return math::mat4{view.clipFromWorld() * shift};
}

}  // namespace

struct Renderer::Parts {
    Parts(gl::Context& c, const field::Aspect& s, std::function<void(std::string)> r)
        : context{c},
          gl{c.api()},
          scene{s},
          report{std::move(r)},
          programs{gl},
          meshes{gl},
          textures{gl},
          maps{gl},
          lights{gl},
          overlay{gl, programs, textures},
          reducer{gl, programs} {}

    struct Seen {
        scene::CameraView camera = {};
        scene::PixelRect pixels = {};
        SceneDrawer* drawer = nullptr;
        std::unique_ptr<truth::RayScene>* rays = nullptr;
        std::vector<const scene::ShadowState*> states = {};
        math::dvec3 origin{0.0};
        /// Factors are blurred on the screen; shadowed is what is looked up for that.
        bool onScreen = false;
        math::View shadowed = {};

        /// Without lights and maps.
        SceneDrawer::ColorPass pass() const { return passOf(camera.view); }
        SceneDrawer::ColorPass passOf(const math::View& view) const {
            return {.clipFromOrigin = clipFromOrigin(view, origin),
                    .clipFromWorld = view.clipFromWorld(),
                    .eyeFromWorld = view.eyeFromWorld,
                    .eyeWorld = view.eyeWorld()};
        }
        /// With as many pixels more on each side.
        math::View widened(int margin) const {
            return math::widened(camera.view, math::dvec2{static_cast<double>(margin)} /
                                                  math::dvec2{pixels.width, pixels.height});
        }
        glm::ivec2 imagesAt() const {
            return onScreen ? glm::ivec2{ScreenBlur::margin} - glm::ivec2{pixels.x, pixels.y}
                            : glm::ivec2{0};
        }
    };

    void warnOnce(const std::string& text) {
        if (warned.insert(text).second && report) report(text);
    }
    Result<Seen> look(const scene::Window& window, const scene::Viewport& viewport);
    Result<Target*> target(const scene::Window& window, bool stencil);
    struct Drawer;
    Drawer& drawer(const scene::Viewport& viewport);
    std::vector<const scene::ShadowState*> statesFor(const scene::Viewport& viewport,
                                                     field::Id group) const;
    Result<void> drawViewport(const scene::Window& window, const scene::Viewport& viewport,
                              FrameStatistics& done, double time);
    /// Into these pixels of the target, whose depth is cleared.
    void beginPass(const Target& target, const scene::PixelRect& pixels) const;
    shadow::ShadowStatistics prepareMaps(const Seen& seen, const scene::Viewport& viewport);
    /// Finds the factors of an upload's lights, where they are traced, and binds them.
    void trace(const Seen& seen, const Lights::Uploaded& lit, RayShadows& into, glm::ivec2 size);
    /// Blurs the factors of an upload's lights on the screen, and binds them.
    void blur(const Seen& seen, const Lights::Uploaded& lit, ScreenBlur& into,
              FrameStatistics& done);
    /// Adds the lights and their maps. In place of maps there are images, where they were made.
    static void light(SceneDrawer::ColorPass& pass, const Seen& seen, const Lights::Uploaded& lit);
    void combine(const Target& target, const Seen& seen,
                 const shadow::ShadowMaps::Arranged& arranged);
    Result<std::optional<shadow_fit::DepthSpan>> depthSpan(const scene::Window& window,
                                                           const scene::ShadowViewport& viewport,
                                                           bool drawn);
    double lap(Clock::time_point& since) const;

    gl::Context& context;
    const gl::Api& gl;
    const field::Aspect& scene;
    std::function<void(std::string)> report;
    Programs programs;
    MeshStore meshes;
    TextureStore textures;
    shadow::ShadowMaps maps;
    Lights lights;
    Overlay overlay;
    DepthReducer reducer;
    std::map<field::Id, Target> targets;
    struct Drawer {
        std::unique_ptr<SceneDrawer> drawer = {};
        std::unique_ptr<truth::RayScene> rays = {};  ///< once something was traced
        bool current = false;                        ///< follows the last change list
    };
    using DrawerKey = std::pair<field::Id, std::vector<field::Id>>;
    std::map<DrawerKey, Drawer> drawers;
    std::map<field::Id, RayShadows> traced;   ///< by viewport
    std::map<field::Id, ScreenBlur> blurred;  ///< by viewport
    std::uint64_t version = 0;                ///< of the scene
    std::vector<field::Id> states;
    field::Applied pending;
    std::set<std::string> warned;
    bool measure = false;
    bool animates = false;
    gl::VertexArray empty{gl};
};

Renderer::Renderer(gl::Context& context, const field::Aspect& scene,
                   std::function<void(std::string)> report)
    : parts_{std::make_unique<Parts>(context, scene, std::move(report))} {
    const gl::Api& gl = context.api();
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

Renderer::~Renderer() = default;

void Renderer::measurePasses(bool on) noexcept { parts_->measure = on; }
bool Renderer::animates() const noexcept { return parts_->animates; }
void Renderer::finish() const { parts_->gl.Finish(); }
void Renderer::forgetShadows() {
    parts_->maps.invalidateAll();
    for (auto& [viewport, traced] : parts_->traced) traced.forget();
    for (auto& [viewport, blurred] : parts_->blurred) blurred.forget();
}

void Renderer::update(const field::Applied& applied) {
    Parts& p = *parts_;
    for (const field::Id id : applied.destroyed) {
        p.meshes.forget(id);
        p.textures.forget(id);
        p.programs.forgetForeign(id);
        p.targets.erase(id);
        p.traced.erase(id);
        p.blurred.erase(id);
        std::erase(p.states, id);
    }
    for (const auto& change : applied.changed) {
        const auto* container = p.scene.find(change.id);
        if (dynamic_cast<const scene::Geometry*>(container) != nullptr) p.meshes.forget(change.id);
        if (dynamic_cast<const scene::Texture*>(container) != nullptr) p.textures.forget(change.id);
        if (dynamic_cast<const scene::ShaderMaterial*>(container) != nullptr)
            p.programs.forgetForeign(change.id);
        if (dynamic_cast<const scene::ShadowState*>(container) != nullptr &&
            std::find(p.states.begin(), p.states.end(), change.id) == p.states.end())
            p.states.push_back(change.id);
    }
    if (!applied.empty()) ++p.version;
    for (auto& [key, drawer] : p.drawers) {
        std::vector<scene::Ref<scene::Node>> excluded;
        for (const field::Id id : key.second) excluded.emplace_back(id);
        drawer.drawer->update(scene::Ref<scene::Node>{key.first}, excluded, applied,
                              [&](const std::string& text) { p.warnOnce(text); });
        if (drawer.drawer->castersRebuilt())
            p.maps.invalidateAll();
        else
            p.maps.invalidate(drawer.drawer->flat().movedBounds());
        if (drawer.rays) drawer.rays->update(drawer.drawer->flat(), drawer.rays->origin());
    }
}

Renderer::Parts::Drawer& Renderer::Parts::drawer(const scene::Viewport& viewport) {
    DrawerKey key{viewport.root->id, {}};
    std::vector<scene::Ref<scene::Node>> excluded;
    if (const auto* shadowed = dynamic_cast<const scene::ShadowViewport*>(&viewport)) {
        for (const auto& ref : shadowed->excludeNodes) {
            key.second.push_back(ref.id);
            excluded.push_back(ref);
        }
    }
    Drawer& entry = drawers[key];
    if (!entry.drawer) {
        entry.drawer = std::make_unique<SceneDrawer>(gl, scene, meshes, textures, programs);
        entry.drawer->update(viewport.root, excluded, {},
                             [&](const std::string& text) { warnOnce(text); });
        maps.invalidateAll();  // what casts is another set now
    }
    return entry;
}

std::vector<const scene::ShadowState*> Renderer::Parts::statesFor(const scene::Viewport& viewport,
                                                                  field::Id group) const {
    std::vector<const scene::ShadowState*> found;
    const auto* shadowed = dynamic_cast<const scene::ShadowViewport*>(&viewport);
    if (shadowed == nullptr || !shadowed->shadowOn) return found;
    for (const field::Id id : states) {
        const auto* state = scene.get(scene::Ref<scene::ShadowState>{id});
        if (state != nullptr && state->group->id == group && !state->clipFromWorld.empty())
            found.push_back(state);
    }
    return found;
}

Result<Renderer::Parts::Seen> Renderer::Parts::look(const scene::Window& window,
                                                    const scene::Viewport& viewport) {
    Seen seen;
    seen.pixels = scene::pixelRect(viewport.rect, window.size);
    if (seen.pixels.width <= 0 || seen.pixels.height <= 0)
        return fail(Errc::edit, "a viewport without area in window \"" + window.title.get() + "\"");
    auto camera = scene::cameraView(scene, viewport.camera,
                                    static_cast<double>(seen.pixels.width) / seen.pixels.height);
    if (!camera) return tl::unexpected{std::move(camera).error()};
    if (!math::isFinite(camera->view.clipFromWorld()))
        return fail(Errc::edit, "a camera whose matrices are not finite");
    seen.camera = *camera;
    Drawer& found = drawer(viewport);
    seen.drawer = found.drawer.get();
    seen.rays = &found.rays;
    seen.states = statesFor(viewport, camera->group.id);
    const shadow::FilterInfo* filter =
        seen.states.empty() ? nullptr : shadow::findFilter(seen.states.front()->filter.get());
    seen.onScreen = filter != nullptr && filter->onScreen;
    seen.shadowed = seen.onScreen ? seen.widened(ScreenBlur::margin) : seen.camera.view;
    seen.origin = seen.states.empty() ? originFor(camera->view) : seen.states.front()->origin.get();
    return seen;
}

Result<Target*> Renderer::Parts::target(const scene::Window& window, bool stencil) {
    const Target::Shape shape{
        .size = window.size, .samples = std::max(1, window.samples.get()), .stencil = stencil};
    const auto found = targets.find(window.id());
    if (found != targets.end() && found->second.shape() == shape) return &found->second;
    targets.erase(window.id());
    auto made = Target::make(gl, shape);
    if (!made) return tl::unexpected{std::move(made).error()};
    return &targets.emplace(window.id(), std::move(*made)).first->second;
}

double Renderer::Parts::lap(Clock::time_point& since) const {
    if (!measure) return 0.0;
    gl.Finish();
    const auto now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - since).count();
    since = now;
    return ms;
}

Result<FrameStatistics> Renderer::draw(const scene::Window& window, double time) {
    FrameStatistics done;
    parts_->animates = false;
    for (const auto& ref : window.viewports) {
        const auto* viewport = dynamic_cast<const scene::Viewport*>(parts_->scene.find(ref.id));
        if (viewport == nullptr) continue;
        auto drawn = parts_->drawViewport(window, *viewport, done, time);
        if (!drawn) return tl::unexpected{std::move(drawn).error()};
    }
    const auto found = parts_->targets.find(window.id());
    if (found != parts_->targets.end()) found->second.resolve(parts_->gl);
    return done;
}

Result<void> Renderer::Parts::drawViewport(const scene::Window& window,
                                           const scene::Viewport& viewport, FrameStatistics& done,
                                           double time) {
    auto looked = look(window, viewport);
    if (!looked) return tl::unexpected{std::move(looked).error()};
    Seen& seen = *looked;
    const bool foreign = seen.drawer->batches().hasForeign();
    animates = animates || foreign;
    auto made = target(window, foreign);
    if (!made) return tl::unexpected{std::move(made).error()};
    const Target& target = **made;
    SceneDrawer& drawer = *seen.drawer;
    auto clock = Clock::now();
    if (measure) gl.Finish();

    drawer.useOrigin(seen.origin);
    const bool shadowed = !seen.states.empty();
    if (shadowed) {
        programs.useFilter(seen.states.front()->filter.get());
        const auto shadows = prepareMaps(seen, viewport);
        done.shadowTriangles += shadows.triangles;
        done.pagesDrawn += shadows.pagesDrawn;
        done.pagesKept += shadows.pagesKept;
        done.pagesUnseen += shadows.pagesUnseen;
        done.mapTexels += shadows.texelsDrawn;
        done.mapBytes = shadows.bytes;
        done.degenerate += shadows.degenerate;
    }
    done.shadowMs += lap(clock);

    const auto lit = lights.upload(drawer.flat(), seen.camera.view, seen.origin, viewport,
                                   shadowed ? &maps : nullptr, seen.imagesAt());
    done.lights += lit.count;
    done.lightsUnseen += lit.unseen;
    done.lightsLeftOut = static_cast<int>(drawer.flat().lightsLeftOut());
    if (drawer.flat().lightsLeftOut() > 0)
        warnOnce(std::to_string(drawer.flat().lightsLeftOut()) +
                 " lights more than the 64 a scene can have are left out");

    if (!lit.traced.empty()) {
        trace(seen, lit, traced.try_emplace(viewport.id(), gl).first->second, window.size);
        done.shadowMs += lap(clock);
    }
    if (seen.onScreen && lit.maps.lights > 0) {
        blur(seen, lit, blurred.try_emplace(viewport.id(), gl, programs).first->second, done);
        done.shadowMs += lap(clock);
    }
    beginPass(target, seen.pixels);

    SceneDrawer::ColorPass pass = seen.pass();
    light(pass, seen, lit);
    pass.time = time;
    const auto count = [&](const PassStatistics& drawn) {
        done.triangles += drawn.triangles;
        done.chunks += drawn.chunks;
        done.chunksCulled += drawn.chunksCulled;
    };
    count(drawer.drawOpaque(pass));
    if (foreign) combine(target, seen, pass.maps);
    overlay.drawBackground(scene, viewport, seen.camera.part);
    count(drawer.drawBlended(pass));
    done.colorMs += lap(clock);
    overlay.drawForegrounds(scene, viewport, seen.pixels);
    gl.Disable(GL_SCISSOR_TEST);
    done.overlayMs += lap(clock);
    return {};
}

void Renderer::Parts::beginPass(const Target& target, const scene::PixelRect& pixels) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.drawn());
    gl.Viewport(pixels.x, pixels.y, pixels.width, pixels.height);
    gl.Scissor(pixels.x, pixels.y, pixels.width, pixels.height);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.DepthMask(GL_TRUE);
    gl.ClearDepthf(0.0F);
    gl.ClearStencil(0);
    gl.Clear(GLbitfield{GL_DEPTH_BUFFER_BIT} |
             (target.shape().stencil ? GLbitfield{GL_STENCIL_BUFFER_BIT} : GLbitfield{0}));
}

Result<std::optional<shadow_fit::DepthSpan>> Renderer::Parts::depthSpan(
    const scene::Window& window, const scene::ShadowViewport& viewport, bool drawn) {
    auto looked = look(window, viewport);
    if (!looked) return tl::unexpected{std::move(looked).error()};
    const Seen& seen = *looked;
    auto made = target(window, seen.drawer->batches().hasForeign());
    if (!made) return tl::unexpected{std::move(made).error()};
    const Target& target = **made;
    const SceneDrawer::ColorPass pass = seen.pass();
    if (!drawn) {
        seen.drawer->useOrigin(seen.origin);
        beginPass(target, seen.pixels);
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        seen.drawer->drawDepth(pass);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    auto span = seen.drawer->blendedDepth(pass);
    if (const auto depths = reducer.reduce(target.depth(gl), seen.pixels)) {
        // From clip depth d = (p z + q) / (r z + s) to -z.
        const math::dmat4& m = seen.camera.view.clipFromEye;
        const auto depthOf = [&](double d) {
            return -(m[3][2] - d * m[3][3]) / (d * m[2][3] - m[2][2]);
        };
        const shadow_fit::DepthSpan opaque{.near = depthOf(depths->second),
                                           .far = depthOf(depths->first)};
        span = together(span, opaque);
    }
    if (span && !(std::isfinite(span->near) && std::isfinite(span->far))) span.reset();
    if (span) span->near = std::max(span->near, 0.0);
    return span;
}

Result<std::optional<shadow_fit::DepthSpan>> Renderer::depthSpan(const scene::Window& window,
                                                                 bool drawn) {
    std::optional<shadow_fit::DepthSpan> all;
    for (const auto& ref : window.viewports) {
        const auto* viewport =
            dynamic_cast<const scene::ShadowViewport*>(parts_->scene.find(ref.id));
        if (viewport == nullptr || !viewport->shadowOn ||
            viewport->depthRange == scene::DepthUse::off)
            continue;
        auto span = parts_->depthSpan(window, *viewport, drawn);
        if (!span) return tl::unexpected{std::move(span).error()};
        all = together(all, *span);
    }
    return all;
}

Result<std::optional<shadow_fit::DepthSpan>> Renderer::depthSpan(bool drawn) {
    Result<std::optional<shadow_fit::DepthSpan>> all;
    parts_->scene.forEach([&](const field::FieldContainer& container) {
        const auto* window = dynamic_cast<const scene::Window*>(&container);
        if (window == nullptr || !all) return;
        auto span = depthSpan(*window, drawn);
        if (span) span = together(*all, *span);
        all = std::move(span);
    });
    return all;
}

shadow::ShadowStatistics Renderer::Parts::prepareMaps(const Seen& seen,
                                                      const scene::Viewport& viewport) {
    std::optional<shadow::DepthOffset> offset;
    const auto* shadowed = dynamic_cast<const scene::ShadowViewport*>(&viewport);
    if (shadowed != nullptr && shadowed->overrideBias)
        offset = {.factor = shadowed->offFactor, .units = shadowed->offBias};
    const auto done = maps.prepare(
        seen.states,
        {.seen = seen.drawer->seenBy(seen.shadowed), .offset = offset ? &*offset : nullptr},
        *seen.drawer);
    if (done.refused > 0)
        warnOnce(
            fmt::format("{} of {} lights shadow nothing: no room for their maps (at most {} "
                        "maps and {} pages)",
                        done.refused, seen.states.size(), shadow::ShadowMaps::maxMaps,
                        shadow::ShadowMaps::maxTableEntries));
    return done;
}

void Renderer::Parts::trace(const Seen& seen, const Lights::Uploaded& lit, RayShadows& into,
                            glm::ivec2 size) {
    auto& rays = *seen.rays;
    if (!rays) {
        rays = std::make_unique<truth::RayScene>(scene);
        rays->update(seen.drawer->flat(), seen.origin);
    }
    rays->moveTo(seen.origin);
    const SceneDrawer::ColorPass depth = seen.passOf(seen.widened(RayShadows::margin));
    const RayShadows::Pass pass{.clipFromWorld = depth.clipFromWorld,
                                .pixels = seen.pixels,
                                .size = size,
                                .version = version};
    if (!into.has(pass, lit.traced)) {
        into.begin(pass, lit.count);
        seen.drawer->drawDepth(depth);
        into.end(pass, lit.traced, *rays);
    }
    into.bind();
}

void Renderer::Parts::blur(const Seen& seen, const Lights::Uploaded& lit, ScreenBlur& into,
                           FrameStatistics& done) {
    const ScreenBlur::Pass pass{.clipFromEye = seen.shadowed.clipFromEye,
                                .eyeFromWorld = seen.shadowed.eyeFromWorld,
                                .pixels = {seen.pixels.width, seen.pixels.height},
                                .maps = lit.maps,
                                .version = version};
    done.kernelPixels = ScreenBlur::reach;
    if (!into.has(pass)) {
        into.start(pass);
        SceneDrawer::ColorPass colors = seen.passOf(seen.shadowed);
        colors.maps = lit.maps;
        for (int first = 0; first < lit.maps.lights; first += ScreenBlur::atOnce) {
            const int count = std::min(ScreenBlur::atOnce, lit.maps.lights - first);
            into.begin(first, count);
            const auto drawn = seen.drawer->drawUnblurred(colors, first, count);
            done.shadowTriangles += drawn.triangles;
            into.blur(first, count);
        }
        done.factorPixels += static_cast<std::uint64_t>(into.size().x) *
                             static_cast<std::uint64_t>(into.size().y) *
                             static_cast<std::uint64_t>(lit.maps.lights);
    }
    done.factorBytes += into.bytes();
    into.bind();
}

void Renderer::Parts::light(SceneDrawer::ColorPass& pass, const Seen& seen,
                            const Lights::Uploaded& lit) {
    pass.scopedLights = lit.scoped;
    pass.lights = lit.count;
    pass.directionalLights = lit.directional;
    pass.maps = lit.maps;
    // What is in an image belongs to the opaque surface behind.
    if (!lit.maps.images) pass.blendedMaps = lit.maps;
    if (seen.onScreen && lit.maps.lights > 0)
        pass.maps = {.mapsPerLight = 1, .lights = lit.maps.lights, .images = true};
}

void Renderer::Parts::combine(const Target& target, const Seen& seen,
                              const shadow::ShadowMaps::Arranged& arranged) {
    const GLuint depth = target.depthCopy(gl);
    const GLuint program = programs.combine(arranged);
    math::dmat4 shift{1.0};
    shift[3] = math::dvec4{-seen.origin, 1.0};
    const math::mat4 originFromClip{shift * glm::inverse(seen.camera.view.clipFromWorld())};
    gl.UseProgram(program);
    gl.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &originFromClip[0][0]);
    gl.ProgramUniform4i(program, 4, seen.pixels.x, seen.pixels.y, seen.pixels.width,
                        seen.pixels.height);
    gl.BindTextureUnit(3, depth);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_EQUAL, 1, 0xff);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_DST_COLOR, GL_ZERO);  // in linear light: the framebuffer is sRGB
    gl.BindVertexArray(empty.id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_STENCIL_TEST);
    gl.Enable(GL_DEPTH_TEST);
}

unsigned Renderer::colorTexture(const scene::Window& window) const {
    const auto found = parts_->targets.find(window.id());
    return found == parts_->targets.end() ? 0U : found->second.color();
}

namespace {

/// GL's rows start at the bottom.
void turnOver(image::Image& picture) {
    const auto row = static_cast<std::ptrdiff_t>(picture.width) * picture.channels;
    const auto first = picture.pixels.begin();
    for (int y = 0; y < picture.height / 2; ++y)
        std::swap_ranges(first + y * row, first + (y + 1) * row,
                         first + (picture.height - 1 - y) * row);
}

}  // namespace

image::Image Renderer::read(const scene::Window& window) {
    const auto found = parts_->targets.find(window.id());
    if (found == parts_->targets.end()) return {};
    const auto size = found->second.shape().size;
    image::Image picture = image::blank(size.x, size.y, 3);
    const gl::Api& gl = parts_->gl;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, found->second.resolved());
    gl.NamedFramebufferReadBuffer(found->second.resolved(), GL_COLOR_ATTACHMENT0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());
    turnOver(picture);
    return picture;
}

Result<image::Image> Renderer::shadowFactor(const scene::Window& window, std::size_t viewportIndex,
                                            scene::Ref<scene::Node> light) {
    Parts& p = *parts_;
    const gl::Api& gl = p.gl;
    const auto* viewport =
        viewportIndex < window.viewports.size()
            ? dynamic_cast<const scene::Viewport*>(p.scene.find(window.viewports[viewportIndex].id))
            : nullptr;
    if (viewport == nullptr)
        return fail(Errc::config, "no viewport " + std::to_string(viewportIndex));
    auto looked = p.look(window, *viewport);
    if (!looked) return tl::unexpected{std::move(looked).error()};
    const auto& seen = *looked;
    SceneDrawer& drawer = *seen.drawer;
    const auto all = drawer.flat().lights();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const auto& use) { return use.node->id() == light.id; });
    if (found == all.end())
        return fail(Errc::config, "no such light: the scene has " + std::to_string(all.size()));
    const auto index = static_cast<int>(found - all.begin());
    drawer.useOrigin(seen.origin);
    if (!seen.states.empty()) {
        p.programs.useFilter(seen.states.front()->filter.get());
        p.prepareMaps(seen, *viewport);
    }
    Parts::Seen whole = seen;
    whole.pixels.x = whole.pixels.y = 0;
    const auto lit =
        p.lights.upload(drawer.flat(), seen.camera.view, seen.origin, *viewport,
                        seen.states.empty() ? nullptr : &p.maps, whole.imagesAt(), index);

    const auto& at = seen.pixels;
    gl::Texture factor{gl, GLenum{GL_TEXTURE_2D}};
    gl::Texture depth{gl, GLenum{GL_TEXTURE_2D}};
    gl::Framebuffer framebuffer{gl};
    RayShadows rays{gl};
    ScreenBlur blurred{gl, p.programs};
    if (!lit.traced.empty()) p.trace(whole, lit, rays, {at.width, at.height});
    FrameStatistics uncounted;
    if (seen.onScreen && lit.maps.lights > 0) p.blur(whole, lit, blurred, uncounted);
    gl.TextureStorage2D(factor.id(), 1, GL_R8, at.width, at.height);
    gl.TextureStorage2D(depth.id(), 1, GL_DEPTH_COMPONENT32F, at.width, at.height);
    gl.NamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, factor.id(), 0);
    gl.NamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl.Viewport(0, 0, at.width, at.height);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.DepthMask(GL_TRUE);
    gl.ClearDepthf(0.0F);
    gl.ClearColor(128.0F / 255.0F, 0.0F, 0.0F, 0.0F);
    gl.Clear(GLbitfield{GL_DEPTH_BUFFER_BIT} | GLbitfield{GL_COLOR_BUFFER_BIT});
    SceneDrawer::ColorPass pass = seen.pass();
    Parts::light(pass, seen, lit);
    drawer.drawFactor(pass);
    image::Image picture = image::blank(at.width, at.height, 1);
    gl.ReadPixels(0, 0, at.width, at.height, GL_RED, GL_UNSIGNED_BYTE, picture.pixels.data());
    turnOver(picture);
    return picture;
}

}  // namespace gnomon::render
