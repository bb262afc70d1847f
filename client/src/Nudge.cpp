#include "Nudge.h"

#include <gnomon/scene/Light.h>

namespace gnomon::client {

Nudge::Nudge(field::Aspect& aspect, SceneTree& tree, std::vector<field::Ref<scene::Node>> lights)
    : aspect_{aspect}, lights_{std::move(lights)} {
    const auto& core = aspect.create<scene::Transform>();
    insertAboveContent(aspect, tree, "nudge", core);
    casters_ = core;
}

void Nudge::step() {
    ++count_;
    const double by = (count_ % 2 == 0 ? 1e-9 : -1e-9) * static_cast<double>(count_);
    edit(*aspect_.get(casters_))->matrix = math::Affine{.translation = {0.0, by, 0.0}};
    for (const auto& ref : lights_) {
        const scene::Node* node = aspect_.get(ref);
        const auto* light =
            node == nullptr ? nullptr : aspect_.get(field::Ref<scene::Light>{node->core->id});
        const scene::Node* beacon = light == nullptr ? nullptr : aspect_.get(light->beacon.get());
        const auto* place = beacon == nullptr
                                ? nullptr
                                : aspect_.get(field::Ref<scene::Transform>{beacon->core->id});
        if (place == nullptr) continue;
        math::Affine matrix = place->matrix;
        matrix.translation.y += by;
        edit(*place)->matrix = matrix;
    }
}

}  // namespace gnomon::client
