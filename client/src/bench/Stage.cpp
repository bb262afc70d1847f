#include "Stage.h"

#include <gnomon/client/AnimationPlayer.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/Light.h>
#include <gnomon/shadow_fit/ShadowFitter.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "../FreeView.h"

namespace gnomon::client {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double orbitStep = 0.05 * degree;
constexpr double lightStep = 0.25 * degree;
constexpr math::dvec3 vertical{0.0, 1.0, 0.0};

math::dmat4 turned(double by, const math::dvec3& centre) {
    const math::dmat4 there = glm::translate(math::dmat4{1.0}, centre);
    return glm::translate(glm::rotate(there, by, vertical), -centre);
}

}  // namespace

std::vector<Step> cameraSteps(const Look& start, const CameraPath* path, int count) {
    std::vector<Step> steps;
    for (int i = 0; i < count; ++i) {
        Look look = start;
        if (path != nullptr)
            look = path->at(path->start() +
                            (path->end() - path->start()) * i / std::max(1, count - 1));
        else
            look.eye =
                math::dvec3{turned(orbitStep * i, start.center) * math::dvec4{start.eye, 1.0}};
        steps.push_back({.look = look});
    }
    return steps;
}

std::vector<Step> lightSteps(const Look& start, int count) {
    std::vector<Step> steps;
    for (int i = 0; i < count; ++i) steps.push_back({.look = start, .turn = lightStep * i});
    return steps;
}

Stage::Stage(field::Aspect& aspect, const Reference& reference, const BenchView& view,
             const config::Shadow& shadow)
    : aspect_{aspect} {
    scene_ = orThrow(prepareScene(
        aspect,
        {.file = reference.file(), .lights = view.lights, .imported = &reference.imported()}));
    AnimationPlayer player;
    player.play(aspect, *scene_.model);
    player.animate(aspect, 0.0);
    window_ = addFreeView(aspect, scene_, {.view = view.view, .shadow = shadow, .server = "bench"});
    const auto lights = activeLights(aspect, scene_);
    if (lights.empty())
        throw Failure{Errc::config, reference.file().string() + ": no light that is on to measure"};
    light_ = lights.front();
    lightAtRest_ = scene::worldFromNode(aspect, lightBeacon());
}

field::Ref<scene::Node> Stage::cameraBeacon() const {
    const auto* viewport =
        dynamic_cast<const scene::Viewport*>(aspect_.find(aspect_.get(window_)->viewports[0].id));
    return aspect_.get(field::Ref<scene::PerspectiveCamera>{viewport->camera->id})->beacon;
}

field::Ref<scene::Node> Stage::lightBeacon() const {
    return aspect_.get(field::Ref<scene::Light>{aspect_.get(light_)->core->id})->beacon;
}

void Stage::place(field::Ref<scene::Node> beacon, const math::dmat4& worldFromBeacon) {
    const auto* transform =
        aspect_.get(field::Ref<scene::Transform>{aspect_.get(beacon)->core->id});
    if (transform == nullptr) return;  // a beacon that cannot be placed stays where it is
    const math::dmat4 now = scene::worldFromNode(aspect_, beacon);
    const math::dmat4 worldFromParent = now * glm::inverse(math::toMatrix(transform->matrix));
    edit(*transform)->matrix = math::toAffine(glm::inverse(worldFromParent) * worldFromBeacon);
}

void Stage::take(const Step& step) {
    place(cameraBeacon(), worldFromEye(step.look));
    place(lightBeacon(), turned(step.turn, step.look.center) * lightAtRest_);
}

math::View Stage::view() const {
    const scene::Window& window = *aspect_.get(window_);
    const auto* viewport =
        dynamic_cast<const scene::Viewport*>(aspect_.find(window.viewports[0].id));
    const glm::ivec2 size = window.size;
    return orThrow(
               scene::cameraView(aspect_, viewport->camera, static_cast<double>(size.x) / size.y))
        .view;
}

shadow_fit::LightShape Stage::lightShape() const {
    const scene::Node* node = aspect_.get(light_);
    const auto* light = aspect_.get(field::Ref<scene::Light>{node->core->id});
    return shadow_fit::lightShape(
        {.node = node,
         .light = light,
         .worldFromBeacon = scene::worldFromNode(aspect_, light->beacon)});
}

}  // namespace gnomon::client
