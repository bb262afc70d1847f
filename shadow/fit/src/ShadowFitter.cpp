#include <gnomon/scene/CameraView.h>
#include <gnomon/shadow_fit/ShadowFitter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::shadow_fit {
namespace {

/// What the fits know of filters: their names, which travel in ShadowState.
constexpr std::array<std::string_view, 5> filterNames{"hard", "pcf", "ppcf", "vsm", "evsm"};

/// The origin a group draws relative to moves in steps, so that a moving head does not change the
/// bits of maps that could be kept. A thousandth of a millimetre of float resolution at this range.
constexpr double originStep = 32.0;

/// Rays a side of a view's picture that the fits judge their maps by.
constexpr int samplesPerSide = 24;

}  // namespace

struct ShadowFitter::Scene {
    explicit Scene(const field::Aspect& session) : flat{session} {}
    scene::FlatScene flat;
    ClusterTree clusters = {};
};

struct ShadowFitter::Group {
    field::Id id = {};
    const scene::ShadowViewport* viewport = nullptr;
    std::vector<math::View> views = {};
};

ShadowFitter::ShadowFitter(std::function<void(std::string)> warn) : warn_{std::move(warn)} {}
ShadowFitter::~ShadowFitter() = default;

void ShadowFitter::warnOnce(const std::string& text) {
    if (std::find(warned_.begin(), warned_.end(), text) != warned_.end()) return;
    warned_.push_back(text);
    if (warn_) warn_(text);
}

LightShape lightShape(const scene::FlatScene::LightUse& use) {
    LightShape shape;
    shape.position = math::dvec3{use.worldFromBeacon[3]};
    const math::dvec3 axis = -math::dvec3{use.worldFromBeacon[2]};
    const double length = glm::length(axis);
    if (length > 0.0 && std::isfinite(length)) shape.direction = axis / length;
    if (const auto* spot = dynamic_cast<const scene::SpotLight*>(use.light)) {
        shape.kind = LightKind::spot;
        shape.halfAngle = spot->outerAngle;
        shape.range = spot->range;
        shape.extent = spot->radius;
    } else if (const auto* point = dynamic_cast<const scene::PointLight*>(use.light)) {
        shape.kind = LightKind::point;
        shape.range = point->range;
        shape.extent = point->radius;
    } else if (const auto* sun = dynamic_cast<const scene::DirectionalLight*>(use.light)) {
        shape.extent = sun->angle;
    }
    return shape;
}

void ShadowFitter::update(field::Aspect& session, const field::Applied& applied) {
    if (applied.empty() && round_ > 0) return;
    findWindows(session, applied);
    ++round_;
    std::vector<Group> groups;
    collectGroups(session, groups);
    for (const Group& group : groups) {
        auto& scene = scenes_[group.viewport->root->id];
        if (!scene) scene = std::make_unique<Scene>(session);
    }
    std::erase_if(scenes_, [&](const auto& entry) {
        return std::none_of(groups.begin(), groups.end(),
                            [&](const Group& g) { return g.viewport->root->id == entry.first; });
    });
    for (auto& [root, scene] : scenes_) {
        scene->flat.update(scene::Ref<scene::Node>{root}, {}, applied);
        scene->clusters.update(scene->flat, applied);
    }
    for (const Group& group : groups) fit(session, group);
    dropUnused(session);
}

void ShadowFitter::findWindows(const field::Aspect& session, const field::Applied& applied) {
    const auto look = [&](const field::FieldContainer& container) {
        if (container.type().id == field::typeIdOf(scene::Window::typeName))
            windows_.insert(container.id());
    };
    if (round_ == 0) session.forEach(look);
    for (const field::Id id : applied.created)
        if (const auto* container = session.find(id)) look(*container);
    for (const field::Id id : applied.destroyed) windows_.erase(id);
}

void ShadowFitter::collectGroups(const field::Aspect& session, std::vector<Group>& groups) const {
    for (const field::Id id : windows_) {
        const auto* window = session.get(scene::Ref<scene::Window>{id});
        for (const auto& ref : window->viewports) {
            const auto* viewport = dynamic_cast<const scene::ShadowViewport*>(session.find(ref.id));
            if (viewport == nullptr || !viewport->shadowOn) continue;
            const auto pixels = scene::pixelRect(viewport->rect, window->size);
            const double aspect =
                pixels.height > 0 ? static_cast<double>(pixels.width) / pixels.height : 1.0;
            const auto camera = scene::cameraView(session, viewport->camera, aspect);
            if (!camera) continue;
            auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
                return g.id == camera->group.id && g.viewport->root == viewport->root;
            });
            if (group == groups.end()) {
                groups.push_back({.id = camera->group.id, .viewport = viewport});
                group = groups.end() - 1;
            }
            // Tiles of one eye share their whole view.
            const bool known =
                std::any_of(group->views.begin(), group->views.end(), [&](const math::View& v) {
                    return v.clipFromEye == camera->whole.clipFromEye &&
                           v.eyeFromWorld == camera->whole.eyeFromWorld;
                });
            if (!known) group->views.push_back(camera->whole);
        }
    }
}

void ShadowFitter::fit(field::Aspect& session, const Group& group) {
    const auto technique = parseTechnique(group.viewport->technique.get(), filterNames);
    if (!technique) return warnOnce(technique.error().what + "; shadows are off");
    if (technique->none()) return;
    const auto& infos = fits();
    const FitInfo& info = *std::find_if(infos.begin(), infos.end(),
                                        [&](const FitInfo& i) { return i.name == technique->fit; });

    const Scene& seen = *scenes_.at(group.viewport->root->id);
    const scene::FlatScene& flat = seen.flat;
    std::vector<Sample> samples;
    if (info.sampled) samples = samplePicture(group.views, seen.clusters.boxes(), samplesPerSide);
    math::dvec3 eye{0.0};
    for (const math::View& view : group.views)
        eye += view.eyeWorld() / static_cast<double>(group.views.size());
    math::dvec3 origin{0.0};
    for (int i = 0; i < 3; ++i) origin[i] = std::round(eye[i] / originStep) * originStep;

    const auto& wanted = group.viewport->lightNodes;
    const int mapSize = std::clamp(group.viewport->mapSize.get(), 16, 16384);
    // Whole pages: a map that is not a multiple is raised to one.
    const int page = std::min(pageTexels, mapSize);
    const int rounded = (mapSize + page - 1) / page * page;
    for (const auto& use : flat.lights()) {
        if (!use.light->on || !use.light->castsShadow) continue;
        if (!wanted.empty() && std::none_of(wanted.begin(), wanted.end(), [&](const auto& ref) {
                return ref.id == use.node->id();
            }))
            continue;
        const LightShape light = lightShape(use);
        if (light.kind == LightKind::point) {
            warnOnce("point lights cast no shadow with technique \"" + technique->fit + "\"");
            continue;
        }
        Held& held = states_[{.light = use.node->id(), .group = group.id}];
        held.used = round_;
        const auto* state = session.get(scene::Ref<scene::ShadowState>{held.state});
        if (state == nullptr) {
            state = &session.create<scene::ShadowState>();
            held.state = state->id();
        }
        receivers_.clear();
        for (const math::View& view : group.views)
            receivers_.add(view, &light, seen.clusters.boxes().tree);
        const math::BoxTree& casters = seen.clusters.boxes().tree;
        if (info.shadowedOnly)
            receivers_.dropUnshadowed(light, casters);
        else if (!receivers_.mayBeShadowed(light, casters))
            receivers_.clear();
        weigh(samples, light, seen.clusters.boxes());
        Fitted fitted = info.fit({.light = light,
                                  .views = group.views,
                                  .receivers = receivers_,
                                  .samples = samples,
                                  .scene = flat.bounds(),
                                  .mapSize = rounded,
                                  .settings = {.range = group.viewport->range}});
        std::vector<math::dmat4> maps;
        for (const FittedMap& map : fitted.maps) {
            if (!math::isFinite(map.clipFromWorld)) {
                fitted.degenerate = true;
                maps.clear();
                break;
            }
            maps.push_back(map.clipFromWorld);
        }
        auto e = edit(*state);
        e->light = *use.node;
        e->group = field::WeakRef<field::FieldContainer>{group.id};
        e->filter = technique->filter;
        e->mapSize = fitted.mapSize > 0 ? fitted.mapSize : rounded;
        e->pageSize = std::min(page, e->mapSize.get());
        e->origin = origin;
        e->degenerate = fitted.degenerate;
        e->clipFromWorld.assign(std::move(maps));
    }
}

void ShadowFitter::dropUnused(field::Aspect& session) {
    for (auto at = states_.begin(); at != states_.end();) {
        if (at->second.used == round_) {
            ++at;
            continue;
        }
        if (const auto* state = session.find(at->second.state)) {
            const auto destroyed = session.destroy(*state);
            GNOMON_EXPECTS(destroyed.has_value(), "nothing refers to a shadow state");
        }
        at = states_.erase(at);
    }
}

}  // namespace gnomon::shadow_fit
