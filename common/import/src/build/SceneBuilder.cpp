#include "build/SceneBuilder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::importer {

using scene::edit;
using scene::Node;
using scene::Ref;

namespace {

/// The exact bounds of a geometry's image; looks at every vertex only where the box around the
/// image of its box would widen @p bounds.
void addExactly(math::Box& bounds, const scene::Geometry& geometry,
                const math::dmat4& worldFromLocal, const math::Box& loose) {
    math::Box both = bounds;
    both.add(loose);
    if (!bounds.empty() && both == bounds) return;
    for (const auto& p : geometry.positions->as<std::array<float, 3>>())
        bounds.add(math::dvec3{worldFromLocal *
                               math::dvec4{double{p[0]}, double{p[1]}, double{p[2]}, 1.0}});
}

template <class T>
std::vector<Ref<T>> refs(const std::vector<const T*>& containers) {
    std::vector<Ref<T>> out;
    for (const T* container : containers) out.push_back(Ref<T>{*container});
    return out;
}

}  // namespace

SceneBuilder::SceneBuilder(const field::TypeRegistry& types, Report& report)
    : report_{report}, aspect_{types, 0, true} {
    group_ = &aspect_.create<scene::Group>();
    content_ = &aspect_.create<Node>();
    auto e = edit(*content_);
    e->name = std::string{"content"};
    e->core = *group_;
}

const Node& SceneBuilder::addTransform(const Node& parent, std::string_view name,
                                       const math::Affine& parentFromNode) {
    const auto made = scene::makeNode<scene::Transform>(aspect_, printable(name));
    edit(made.core)->matrix = parentFromNode;
    edit(parent)->addChild(made.node);
    return made.node;
}

const Node& SceneBuilder::addGroup(const Node& parent, std::string_view name) {
    const auto& node = aspect_.create<Node>();
    {
        auto e = edit(node);
        e->name = printable(name);
        e->core = *group_;
    }
    edit(parent)->addChild(node);
    return node;
}

void SceneBuilder::addShape(const Node& parent, std::string_view given,
                            const scene::Geometry& geometry, const scene::Material& material,
                            const math::dmat4& worldFromParent) {
    const auto name = printable(given);
    const math::Box local{.min = math::dvec3{geometry.boundsMin.get()},
                          .max = math::dvec3{geometry.boundsMax.get()}};
    const math::Box world = math::transformed(local, worldFromParent);
    const auto finite = [](const math::dvec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    if (!math::isFinite(worldFromParent) || !finite(world.min) || !finite(world.max)) {
        report_.warn(fmt::format("\"{}\": its place in the world is not finite; left out", name));
        return;
    }
    auto& group = materialGroups_[material.id()];
    if (group == nullptr) {
        group = &aspect_.create<scene::MaterialGroup>();
        edit(*group)->material = material;
    }
    const auto& holder = aspect_.create<Node>();
    const auto& shape = aspect_.create<Node>();
    {
        auto e = edit(shape);
        e->name = name;
        e->core = geometry;
    }
    {
        auto e = edit(holder);
        e->name = name;
        e->core = *group;
        e->addChild(shape);
    }
    edit(parent)->addChild(holder);

    addExactly(bounds_, geometry, worldFromParent, world);
    boxes_.push_back(world);
    if (geometry.primitive == scene::Primitive::triangles)
        triangles_ += geometry.indices->size() / (3 * sizeof(std::uint32_t));
}

const Node& SceneBuilder::addLights(const Node& root, std::vector<const Node*>& made) {
    const std::size_t room = maxLevels > levels_ ? maxLevels - levels_ : 0;
    const std::size_t kept = std::min({lights_.size(), maxLights, room});
    if (kept < lights_.size()) {
        report_.warn(fmt::format("{} of {} lights left out: the limit is {} here",
                                 lights_.size() - kept, lights_.size(), kept));
        lights_.resize(kept);
    }
    const double factor = exposure(lights_, boxes_, bounds_);
    const Node* above = &root;
    for (const LightDraft& draft : lights_) {
        const double intensity = draft.intensity * factor;
        const auto add = [&](const auto& light) {
            const auto e = edit(light.core);
            e->color = draft.color;
            e->intensity = static_cast<float>(intensity);
            e->beacon = *draft.beacon;
            made.push_back(&light.node);
            edit(*above)->addChild(light.node);
            above = &light.node;
        };
        const auto addLocal = [&](const auto& light) {
            const auto e = edit(light.core);
            e->attenuation = math::vec3{0.0F, 0.0F, 1.0F};
            e->range =
                static_cast<float>(draft.range > 0.0 ? draft.range : derivedRange(intensity));
        };
        if (draft.kind == LightDraft::Kind::directional) {
            add(scene::makeNode<scene::DirectionalLight>(aspect_, printable(draft.name)));
        } else if (draft.kind == LightDraft::Kind::point) {
            const auto light = scene::makeNode<scene::PointLight>(aspect_, printable(draft.name));
            add(light);
            addLocal(light);
        } else {
            const auto light = scene::makeNode<scene::SpotLight>(aspect_, printable(draft.name));
            add(light);
            addLocal(light);
            const auto e = edit(light.core);
            e->innerAngle = static_cast<float>(draft.innerAngle);
            e->outerAngle = static_cast<float>(draft.outerAngle);
        }
    }
    return *above;
}

std::vector<const scene::PerspectiveCamera*> SceneBuilder::makeCameras() {
    std::vector<const scene::PerspectiveCamera*> made;
    for (const CameraDraft& draft : cameras_) {
        const auto& camera = aspect_.create<scene::PerspectiveCamera>();
        double far = draft.far;
        if (!(far > draft.near)) {
            // To the far side of the scene, seen from where it stands now, and room to move.
            const double reach =
                bounds_.empty() ? 0.0
                                : glm::length(bounds_.centre() - draft.eyeWorld) + bounds_.radius();
            far = std::max(draft.near * 1000.0, 2.0 * reach);
        }
        auto e = edit(camera);
        e->beacon = *draft.beacon;
        e->fovy = draft.fovy;
        e->near = draft.near;
        e->far = far;
        made.push_back(&camera);
    }
    return made;
}

field::ChangeList SceneBuilder::finish(const std::string& source) {
    const auto& root = aspect_.create<Node>();
    {
        auto e = edit(root);
        e->name = printable(source);
        e->core = *group_;
    }
    std::vector<const Node*> lights;
    edit(addLights(root, lights))->addChild(*content_);
    const auto cameras = makeCameras();

    const auto& imported = aspect_.create<scene::ImportedScene>();
    {
        auto e = edit(imported);
        e->source = printable(source);
        e->root = root;
        e->animations.assign(refs(animations_));
        e->poses.assign(refs(poses_));
        e->cameras.assign(refs(cameras));
        e->lights.assign(refs(lights));
        e->warnings.assign(report_.warnings());
        e->boundsMin =
            bounds_.empty() ? math::dvec3{1.0} : bounds_.min;  // no infinity to trip over
        e->boundsMax = bounds_.empty() ? math::dvec3{-1.0} : bounds_.max;
        e->trianglesDrawn = triangles_;
    }
    return aspect_.commit();
}

}  // namespace gnomon::importer
