#include "FreeView.h"

#include <gnomon/client/AnimationPlayer.h>
#include <gnomon/client/WallSetup.h>

namespace gnomon::client {
namespace {

constexpr double defaultFovy = 1.0471975511965976;  // 60 degrees

}  // namespace

PreparedScene loadScene(field::Aspect& aspect, Console& console, const LoadOptions& options) {
    auto prepared =
        orThrow(prepareScene(aspect, {.file = options.file,
                                      .lights = options.lights,
                                      .progress = [&](double share, const std::string& what) {
                                          console.progress("loading", share, what);
                                      }}));
    if (!prepared.model) return prepared;
    for (const auto& warning : prepared.model->warnings) console.log(LogLevel::warning, warning);
    AnimationPlayer player;
    player.play(aspect, *prepared.model);
    player.animate(aspect, options.animationTime);
    return prepared;
}

field::Ref<scene::Window> addFreeView(field::Aspect& aspect, const PreparedScene& prepared,
                                      const FreeViewOptions& options) {
    const auto size = options.view.size.value_or(defaultViewSize);
    const double shape = static_cast<double>(size[0]) / size[1];
    const auto fallback =
        defaultView(aspect, prepared, opening(options.view.fovy.value_or(defaultFovy), shape));
    const auto given = options.view.look();
    const Look look = given.value_or(fallback.look);
    const double fovy =
        options.view.fovy.value_or(given ? defaultFovy : fallback.fovy.value_or(defaultFovy));
    DepthRange range = depthRange(prepared.bounds, look.eye);
    range.near = options.view.near.value_or(range.near);
    range.far = options.view.far.value_or(range.far);
    const auto& camera = addCamera(aspect, prepared.tree, look, fovy, range);

    const auto& viewport = aspect.create<scene::ShadowViewport>();
    const auto& sky = aspect.create<scene::GradientBackground>();
    edit(sky)->stops.assign(
        {math::vec4{0.72F, 0.79F, 0.86F, 0.0F}, math::vec4{0.16F, 0.33F, 0.62F, 1.0F}});
    {
        auto e = edit(viewport);
        e->camera = camera;
        e->root = prepared.tree.root;
        e->background = sky;
        applyShadow(options.shadow, *e);
    }
    const auto& window = aspect.create<scene::Window>();
    auto e = edit(window);
    e->server = options.server;
    e->size = glm::ivec2{size[0], size[1]};
    e->samples = options.samples;
    e->viewports.pushBack(viewport);
    return window;
}

}  // namespace gnomon::client
