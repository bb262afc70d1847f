#include <gnomon/scene/CameraView.h>
#include <gnomon/shadow_fit/ShadowFitter.h>
#include <gnomon/shadow_fit/Softness.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::shadow_fit {
namespace {

std::span<const std::string_view> filterNames() {
    static const auto all = [] {
        std::vector<std::string_view> names;
        for (const FilterUse& use : filterUses()) names.push_back(use.name);
        return names;
    }();
    return all;
}

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
    field::Id viewport = {};
    field::Id root = {};
    std::vector<math::View> views = {};
    glm::ivec2 pixels{0};  ///< of the whole screen
};

/// What the fits of a group's lights have in common.
struct ShadowFitter::Plan {
    const scene::ShadowViewport& viewport;
    const Scene& seen;
    const FitInfo& info;
    const FilterUse& filter;
    std::optional<DepthSpan> depth = {};
    std::vector<Sample> samples = {};  ///< weighed anew for each light
    math::dvec3 origin{0.0};
    int mapSize = 0, pageSize = 0;
    int cascades = 0;
};

ShadowFitter::ShadowFitter(std::function<void(std::string)> warn) : warn_{std::move(warn)} {}
ShadowFitter::~ShadowFitter() = default;

bool ShadowFitter::wantsDepth() const noexcept { return !waiting_.empty(); }

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

bool wantsShadows(const scene::ShadowViewport& viewport, const scene::FlatScene::LightUse& use) {
    const auto& wanted = viewport.lightNodes;
    return use.light->on && use.light->castsShadow &&
           (wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const auto& ref) {
                return ref.id == use.node->id();
            }));
}

void ShadowFitter::update(field::Aspect& session, const field::Applied& applied) {
    if (applied.empty() && round_ > 0 && !depthChanged_) return;
    depthChanged_ = false;
    findWindows(session, applied);
    ++round_;
    std::vector<Group> groups;
    collectGroups(session, groups);
    for (const Group& group : groups) {
        auto& scene = scenes_[group.root];
        if (!scene) scene = std::make_unique<Scene>(session);
    }
    std::erase_if(scenes_, [&](const auto& entry) {
        return std::none_of(groups.begin(), groups.end(),
                            [&](const Group& g) { return g.root == entry.first; });
    });
    for (auto& [root, scene] : scenes_) {
        scene->flat.update(scene::Ref<scene::Node>{root}, {}, applied);
        scene->clusters.update(scene->flat, applied);
    }
    waiting_.clear();
    previous_ = false;
    for (Group& group : groups) {
        const auto* viewport = session.get(scene::Ref<scene::ShadowViewport>{group.viewport});
        const bool previous = viewport->depthRange == scene::DepthUse::previous;
        previous_ = previous_ || previous;
        const bool exact = viewport->depthRange == scene::DepthUse::exact &&
                           viewport->technique.get() != "none" &&
                           viewport->technique.get() != "ray";
        if (exact && keep(group)) {
            waiting_.push_back(std::move(group));
            continue;
        }
        fit(session, group, previous ? lately_ : std::nullopt);
        if (exact) waiting_.push_back(std::move(group));
    }
    dropUnused(session);
}

void ShadowFitter::fit(field::Aspect& session, const std::optional<DepthSpan>& seen) {
    // Rounding, and samples of a pixel that see a little more than its middle.
    constexpr double margin = 0.01;
    // Nothing seen, nothing to shadow: any span without anything in it.
    DepthSpan span{.near = 0.0, .far = -1.0};
    if (seen) span = {.near = seen->near * (1.0 - margin), .far = seen->far * (1.0 + margin)};
    ++round_;
    for (auto& [key, held] : states_)
        if (std::none_of(waiting_.begin(), waiting_.end(),
                         [&](const Group& group) { return group.id == key.group; }))
            held.used = round_;
    for (const Group& group : std::exchange(waiting_, {})) fit(session, group, span);
    dropUnused(session);
}

void ShadowFitter::depthSeen(const std::optional<DepthSpan>& seen) {
    // The view moves on: what is a little nearer or farther is shadowed, too.
    constexpr double margin = 1.25;
    if (!seen) return;
    const bool holds = lately_ && lately_->near <= seen->near && lately_->far >= seen->far &&
                       lately_->near * margin * margin >= seen->near &&
                       lately_->far <= seen->far * margin * margin;
    if (holds) return;
    lately_ = {.near = seen->near / margin, .far = seen->far * margin};
    depthChanged_ = true;
}

bool ShadowFitter::keep(const Group& group) {
    bool any = false;
    for (auto& [key, held] : states_) {
        if (key.group != group.id) continue;
        held.used = round_;
        any = true;
    }
    return any;
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
                return g.id == camera->group.id && g.root == viewport->root->id;
            });
            if (group == groups.end()) {
                groups.push_back({.id = camera->group.id,
                                  .viewport = viewport->id(),
                                  .root = viewport->root->id});
                group = groups.end() - 1;
            }
            const auto whole = [](int part, double share) {
                // Tiles of tiles may have a share of nothing.
                return share > 0.0 ? static_cast<int>(std::lround(std::min(part / share, 65536.0)))
                                   : part;
            };
            group->pixels =
                glm::max(group->pixels, glm::ivec2{whole(pixels.width, camera->part.width),
                                                   whole(pixels.height, camera->part.height)});
            // Tiles of one eye share their whole view.
            const bool known =
                std::any_of(group->views.begin(), group->views.end(), [&](const math::View& v) {
                    return v.clipFromEye == camera->whole.clipFromEye &&
                           v.eyeFromWorld == camera->whole.eyeFromWorld;
                });
            if (!known && camera->whole.usable()) group->views.push_back(camera->whole);
        }
    }
}

void ShadowFitter::fit(field::Aspect& session, const Group& group,
                       const std::optional<DepthSpan>& depth) {
    const auto& viewport = *session.get(scene::Ref<scene::ShadowViewport>{group.viewport});
    auto technique = parseTechnique(viewport.technique.get(), filterNames());
    if (!technique) return warnOnce(technique.error().what + "; shadows are off");
    if (technique->none()) return;
    const auto& infos = fits();
    const FitInfo& info = *std::find_if(infos.begin(), infos.end(),
                                        [&](const FitInfo& i) { return i.name == technique->fit; });
    Plan plan{.viewport = viewport,
              .seen = *scenes_.at(group.root),
              .info = info,
              .filter = *findFilterUse(technique->filter),
              .depth = depth};
    if (info.sampled)
        plan.samples =
            samplePicture(group.views, plan.seen.clusters.boxes(), samplesPerSide, depth);
    math::dvec3 eye{0.0};
    for (const math::View& view : group.views)
        eye += view.eyeWorld() / static_cast<double>(group.views.size());
    // Near what is seen, too: from far away all of it would be floats that differ in the last bits.
    const math::Box bounds = plan.seen.flat.bounds();
    if (!bounds.empty()) eye = glm::clamp(eye, bounds.min, bounds.max);
    for (int i = 0; i < 3; ++i) plan.origin[i] = std::round(eye[i] / originStep) * originStep;
    const auto shadows = [&](const scene::FlatScene::LightUse& use) {
        return wantsShadows(viewport, use);
    };
    const auto lights = plan.seen.flat.lights();
    const auto count = static_cast<int>(std::count_if(lights.begin(), lights.end(), shadows));
    const int asked =
        viewport.mapSize > 0 ? viewport.mapSize.get() : scene::mapSizeFor(group.pixels);
    int mapSize = std::clamp(asked, 16, 16384);
    // Many large maps: all are coarser, rather than some lights without.
    const auto pagesOf = [](int size) { return (size + pageTexels - 1) / pageTexels; };
    while (mapSize > pageTexels && pagesOf(mapSize) * pagesOf(mapSize) * count > mostPages)
        mapSize /= 2;
    plan.cascades =
        std::clamp(viewport.cascades.get(), 2, std::max(2, mostMaps / std::max(count, 1)));
    // Whole pages: a map that is not a multiple is raised to one.
    plan.pageSize = std::min(plan.filter.pageTexels, mapSize);
    plan.mapSize = (mapSize + plan.pageSize - 1) / plan.pageSize * plan.pageSize;

    for (const auto& use : lights)
        if (shadows(use)) fit(session, group, use, plan);
}

void ShadowFitter::fit(field::Aspect& session, const Group& group,
                       const scene::FlatScene::LightUse& use, Plan& plan) {
    Held& held = states_[{.light = use.node->id(), .group = group.id}];
    held.used = round_;
    const auto* state = session.get(scene::Ref<scene::ShadowState>{held.state});
    if (state == nullptr) {
        state = &session.create<scene::ShadowState>();
        held.state = state->id();
    }
    const Boxes boxes = plan.seen.clusters.boxes();
    LightShape light = lightShape(use);
    const bool placed = usableLight(light).has_value();
    const auto receive = [&] {
        receivers_.clear();
        if (!placed) return;
        for (const math::View& view : group.views)
            receivers_.add(view, &light, boxes.tree, plan.depth);
    };
    receive();
    if (light.kind == LightKind::point && !receivers_.empty()) {
        light = spotThatSees(light, receivers_.points());
        if (light.halfAngle == widestOfPoint) {
            warnOnce(
                "a point light amid what it lights: its shadow map shows 150 degrees of it, "
                "the rest is lit");
            receive();
        }
    }
    const double softness =
        plan.viewport.softness > 0.0F ? plan.viewport.softness.get() : softnessOf(light);
    const double reach = !placed ? 0.0
                                 : lookupReach(plan.filter, light, softness,
                                               0.5 * plan.viewport.kernelWidth / plan.mapSize,
                                               receivers_.points(), boxes.tree);
    if (plan.info.shadowedOnly)
        receivers_.dropUnshadowed(light, boxes.tree, reach);
    else if (!receivers_.mayBeShadowed(light, boxes.tree, reach))
        receivers_.clear();
    if (placed) weigh(plan.samples, light, boxes);
    const Fitted made =
        fitted(plan.info, {.light = light,
                           .views = group.views,
                           .receivers = receivers_,
                           .samples = plan.samples,
                           .scene = plan.seen.flat.bounds(),
                           .mapSize = plan.mapSize,
                           .settings = {.range = plan.viewport.range, .cascades = plan.cascades},
                           .reach = reach});
    std::vector<math::dmat4> maps;
    for (const FittedMap& map : made.maps) maps.push_back(map.clipFromWorld);
    auto e = edit(*state);
    e->light = *use.node;
    e->group = field::WeakRef<field::FieldContainer>{group.id};
    e->filter = std::string{plan.filter.name};
    e->mapSize = made.mapSize > 0 ? made.mapSize : plan.mapSize;
    e->pageSize = std::min(plan.pageSize, e->mapSize.get());
    e->origin = plan.origin;
    e->source = light.kind == LightKind::directional ? math::dvec4{-light.direction, 0.0}
                                                     : math::dvec4{light.position, 1.0};
    e->extent = static_cast<float>(extentOf(light));
    e->softness = static_cast<float>(softness);
    e->reach = static_cast<float>(reach);
    e->kernelWidth = plan.viewport.kernelWidth;
    e->kernelSamples = plan.viewport.kernelSamples;
    e->quality = plan.viewport.qualityMode ? 8.0F : 1.0F;
    e->degenerate = made.degenerate || !placed;
    e->clipFromWorld.assign(std::move(maps));
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
