#pragma once

#include <vector>

#include "build/SceneBuilder.h"
#include "gltf/Accessors.h"
#include "gltf/Pose.h"

namespace gnomon::importer {

/// What an animation needs to know of a node: nullptr where the scene does not have it.
struct GltfAnimated {
    const scene::Transform* transform = nullptr;
    GltfPose pose = {};
    bool posed = false;  ///< has its AnimationPose already
};

/// Adds the file's animations. Channels with faults are left out, each with a warning.
/// @param nodes  by node number
void addAnimations(const GltfDocument& document, Accessors& accessors,
                   std::vector<GltfAnimated>& nodes, SceneBuilder& to);

}  // namespace gnomon::importer
