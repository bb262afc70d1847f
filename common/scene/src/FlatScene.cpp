#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/FlatScene.h>

#include <algorithm>

namespace gnomon::scene {

math::Box FlatScene::localBounds(const Geometry& geometry) {
    math::Box box;
    const math::vec3 low = geometry.boundsMin;
    const math::vec3 high = geometry.boundsMax;
    if (low.x <= high.x && low.y <= high.y && low.z <= high.z && !geometry.chunks.empty()) {
        box.min = math::dvec3{low};
        box.max = math::dvec3{high};
    }
    return box;
}

void FlatScene::update(Ref<Node> root, std::span<const Ref<Node>> excluded,
                       const field::Applied& applied) {
    rebuilt_ = lightsChanged_ = false;
    moved_.clear();
    movedBounds_.clear();
    bool structure =
        !built_ || root != root_ ||
        !std::equal(excluded.begin(), excluded.end(), excluded_.begin(), excluded_.end());
    bool lights = false;
    bool places = false;
    static constexpr field::TypeId transformType = field::typeIdOf(Transform::typeName);
    static constexpr field::TypeId nodeType = field::typeIdOf(Node::typeName);
    for (const auto& change : applied.changed) {
        if (structure) break;
        const field::FieldContainer* container = aspect_.find(change.id);
        if (container == nullptr) continue;
        const field::TypeId type = container->type().id;
        if (!parts_.contains(change.id)) {
            // It may stand above a light's beacon, which may hang anywhere.
            lights = lights || type == transformType || type == nodeType;
            continue;
        }
        if (type == transformType) {
            const auto [first, last] = placesOf_.equal_range(change.id);
            for (auto at = first; at != last; ++at) places_[at->second].dirty = places = true;
        } else if (dynamic_cast<const Light*>(container) != nullptr) {
            lights = true;
        } else if (dynamic_cast<const Material*>(container) == nullptr) {
            structure = true;
        }
    }
    for (const field::Id id : applied.destroyed) structure = structure || parts_.contains(id);
    if (structure) {
        rebuild(root, excluded);
    } else if (places || (lights && !lights_.empty())) {
        if (places) refreshPlaces();
        refreshLights();
    }
}

void FlatScene::rebuild(Ref<Node> root, std::span<const Ref<Node>> excluded) {
    root_ = root;
    excluded_.assign(excluded.begin(), excluded.end());
    built_ = rebuilt_ = lightsChanged_ = true;
    places_.clear();
    instances_.clear();
    lights_.clear();
    placesOf_.clear();
    parts_.clear();
    lightsLeftOut_ = 0;
    bounds_ = {};

    struct Open {
        const Node* node = nullptr;
        std::uint32_t place = 0;
        std::uint64_t lights = 0;
        const Material* material = nullptr;
        bool castsShadow = true;
    };
    places_.push_back({.parent = 0});
    std::vector<Open> open;
    if (const Node* top = aspect_.get(root)) open.push_back({.node = top});
    while (!open.empty()) {
        Open at = open.back();
        open.pop_back();
        parts_.insert(at.node->id());
        for (const auto& ref : excluded) at.castsShadow = at.castsShadow && ref.id != at.node->id();
        const NodeCore* core = aspect_.get(at.node->core.get());
        if (core != nullptr) parts_.insert(core->id());
        if (const auto* transform = dynamic_cast<const Transform*>(core)) {
            const auto index = static_cast<std::uint32_t>(places_.size());
            places_.push_back(
                {.parent = at.place,
                 .transform = transform,
                 .world = places_[at.place].world * math::toMatrix(transform->matrix)});
            placesOf_.emplace(transform->id(), index);
            at.place = index;
        } else if (const auto* geometry = dynamic_cast<const Geometry*>(core)) {
            const math::dmat4& world = places_[at.place].world;
            Instance instance{.node = at.node,
                              .geometry = geometry,
                              .material = at.material,
                              .place = at.place,
                              .lights = at.lights,
                              .castsShadow = at.castsShadow,
                              .mirrored = glm::determinant(math::dmat3{world}) < 0.0,
                              .bounds = math::transformed(localBounds(*geometry), world)};
            bounds_.add(instance.bounds);
            instances_.push_back(instance);
        } else if (const auto* group = dynamic_cast<const MaterialGroup*>(core)) {
            at.material = aspect_.get(group->material.get());
            if (at.material != nullptr) parts_.insert(at.material->id());
        } else if (const auto* light = dynamic_cast<const Light*>(core)) {
            if (lights_.size() < maxLights) {
                at.lights |= std::uint64_t{1} << lights_.size();
                lights_.push_back({.node = at.node, .light = light});
                if (const Node* beacon = aspect_.get(light->beacon.get()))
                    parts_.insert(beacon->id());
            } else {
                ++lightsLeftOut_;
            }
        }
        const auto& children = at.node->children();
        for (std::size_t i = children.size(); i-- > 0;)
            if (const Node* child = aspect_.get(children[i]))
                open.push_back({.node = child,
                                .place = at.place,
                                .lights = at.lights,
                                .material = at.material,
                                .castsShadow = at.castsShadow});
    }
    // Instances by place, so that a moved place finds its own.
    instanceOrder_.resize(instances_.size());
    for (std::uint32_t i = 0; i < instanceOrder_.size(); ++i) instanceOrder_[i] = i;
    std::stable_sort(instanceOrder_.begin(), instanceOrder_.end(),
                     [&](auto a, auto b) { return instances_[a].place < instances_[b].place; });
    std::uint32_t next = 0;
    for (std::uint32_t place = 0; place < places_.size(); ++place) {
        places_[place].firstInstance = next;
        while (next < instanceOrder_.size() && instances_[instanceOrder_[next]].place == place)
            ++next;
        places_[place].lastInstance = next;
    }
    refreshLights();
}

void FlatScene::refreshPlaces() {
    // Parents come before their children, so one sweep carries changes down.
    for (std::size_t i = 1; i < places_.size(); ++i) {
        Place& place = places_[i];
        const Place& parent = places_[place.parent];
        if (!place.dirty && !parent.dirty) continue;
        place.dirty = true;
        place.world = parent.world * math::toMatrix(place.transform->matrix);
        for (std::uint32_t k = place.firstInstance; k < place.lastInstance; ++k) {
            const std::uint32_t index = instanceOrder_[k];
            Instance& instance = instances_[index];
            math::Box swept = instance.bounds;
            instance.bounds = math::transformed(localBounds(*instance.geometry), place.world);
            swept.add(instance.bounds);
            const bool mirrored = glm::determinant(math::dmat3{place.world}) < 0.0;
            rebuilt_ = rebuilt_ || mirrored != instance.mirrored;
            instance.mirrored = mirrored;
            moved_.push_back(index);
            movedBounds_.push_back(swept);
        }
    }
    for (Place& place : places_) place.dirty = false;
    bounds_ = {};
    for (const Instance& instance : instances_) bounds_.add(instance.bounds);
}

void FlatScene::refreshLights() {
    for (LightUse& use : lights_) {
        const Ref<Node> beacon =
            use.light->beacon.get() ? use.light->beacon.get() : Ref<Node>{*use.node};
        const math::dmat4 world = worldFromNode(aspect_, beacon);
        use.worldFromBeacon = world;
    }
    lightsChanged_ = true;
}

}  // namespace gnomon::scene
