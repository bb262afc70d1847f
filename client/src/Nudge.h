#pragma once

#include <gnomon/client/SceneTree.h>
#include <gnomon/scene/Node.h>

#include <vector>

namespace gnomon::client {

/// Makes a still scene move, by less than can be seen: everything that casts, and the lights. What
/// `--dynamic` means: nothing drawn before can serve again.
class Nudge {
public:
    Nudge(field::Aspect& aspect, SceneTree& tree, std::vector<field::Ref<scene::Node>> lights);
    void step();

private:
    field::Aspect& aspect_;
    std::vector<field::Ref<scene::Node>> lights_;
    field::Ref<scene::Transform> casters_ = {};
    std::int64_t count_ = 0;
};

}  // namespace gnomon::client
