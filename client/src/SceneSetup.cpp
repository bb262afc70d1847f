#include <gnomon/client/SceneSetup.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/Light.h>

#include <algorithm>

namespace gnomon::client {

using field::edit;
using field::Ref;

namespace {

bool contains(const math::Box& box, const math::dvec3& point) {
    return glm::all(glm::lessThanEqual(box.min, point)) &&
           glm::all(glm::lessThanEqual(point, box.max));
}

/// Far enough ahead to be a target: the middle of the scene as seen along the view direction.
double aheadOf(const math::Box& bounds, const math::dvec3& eye, const math::dvec3& forward) {
    if (bounds.empty()) return 1.0;
    const double along = glm::dot(bounds.centre() - eye, forward);
    return std::max({along, bounds.radius() * 0.1, 1e-3});
}

Look lookOf(const field::Aspect& aspect, const scene::PerspectiveCamera& camera,
            const math::Box& bounds) {
    const math::dmat4 world = scene::worldFromNode(aspect, camera.beacon);
    const math::dvec3 eye{world[3]};
    // A beacon scaled to nothing has no direction; lookAt then looks along -z.
    const math::dvec3 back{world[2]};
    const double length = glm::length(back);
    const math::dvec3 forward = length > 0.0 ? -back / length : math::dvec3{0.0, 0.0, -1.0};
    Look look;
    look.eye = eye;
    look.center = eye + forward * aheadOf(bounds, eye, forward);
    look.up = math::dvec3{world[1]};
    return look;
}

/// A room of metres suits a scene one stands in; a scene seen from outside is put on the screen.
double suitableScale(const Look& look, const math::Box& bounds, double focus) {
    if (!(focus > 0.0)) return 1.0;
    const bool walkable = bounds.radius() > 2.0 && bounds.radius() < 500.0;
    if (!bounds.empty() && contains(bounds, look.eye) && walkable) return 1.0;
    return glm::length(look.center - look.eye) / focus;
}

}  // namespace

Result<PreparedScene> prepareScene(field::Aspect& aspect, const SceneOptions& options) {
    return prepareScene(aspect, makeSceneTree(aspect), options);
}

Result<PreparedScene> prepareScene(field::Aspect& aspect, const SceneTree& tree,
                                   const SceneOptions& options) {
    PreparedScene prepared;
    prepared.tree = tree;
    bool lit = false;
    if (!options.file.empty()) {
        auto model = options.imported != nullptr
                         ? adoptModel(aspect, prepared.tree, *options.imported)
                         : loadModel(aspect, prepared.tree, options.file, options.progress);
        if (!model) return tl::unexpected{model.error()};
        prepared.bounds = model->bounds;
        if (!options.lights.empty()) switchOffLights(aspect, *model);
        lit = hasLight(aspect, *model);
        prepared.model = *std::move(model);
    }
    addLights(aspect, prepared.tree, options.lights);
    if (!lit && options.lights.empty()) {
        addDefaultSun(aspect, prepared.tree);
        prepared.defaultSun = true;
    }
    return prepared;
}

std::vector<Ref<scene::Node>> activeLights(const field::Aspect& aspect,
                                           const PreparedScene& scene) {
    std::vector<Ref<scene::Node>> all = scene.tree.lights;
    if (scene.model) all.insert(all.end(), scene.model->lights.begin(), scene.model->lights.end());
    std::erase_if(all, [&](Ref<scene::Node> ref) {
        const scene::Node* node = aspect.get(ref);
        const auto* light =
            node == nullptr ? nullptr : aspect.get(Ref<scene::Light>{node->core->id});
        return light == nullptr || !light->on;
    });
    return all;
}

DefaultView defaultView(const field::Aspect& aspect, const PreparedScene& scene,
                        const Opening& through, double focus) {
    DefaultView result;
    const auto* camera = scene.model && !scene.model->cameras.empty()
                             ? aspect.get(scene.model->cameras.front())
                             : nullptr;
    if (camera != nullptr) {
        result.look = lookOf(aspect, *camera, scene.bounds);
        result.fovy = camera->fovy;
    } else {
        result.look = lookAtBox(scene.bounds, through);
    }
    result.look.scale = suitableScale(result.look, scene.bounds, focus);
    return result;
}

const scene::PerspectiveCamera& addCamera(field::Aspect& aspect, const SceneTree& tree,
                                          const Look& look, double fovy, const DepthRange& range) {
    const auto& beacon = addBeacon(aspect, tree, "camera", worldFromEye(look));
    const auto& camera = aspect.create<scene::PerspectiveCamera>();
    auto e = edit(camera);
    e->beacon = beacon;
    e->fovy = fovy;
    e->near = range.near;
    e->far = range.far;
    return camera;
}

}  // namespace gnomon::client
