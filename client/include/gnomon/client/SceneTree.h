#pragma once

#include <gnomon/scene/Node.h>

#include <vector>

namespace gnomon::client {

/// The upper end of the scene: root -> added lights, one above the other -> content -> models.
/// A light lights only what is below its node, so lights are inserted right above the content.
struct SceneTree {
    field::Ref<scene::Node> root = {};     ///< what viewports show
    field::Ref<scene::Node> beacons = {};  ///< beside the lights: beacons of lights and cameras
    field::Ref<scene::Node> content = {};  ///< models are its children
    std::vector<field::Ref<scene::Node>> lights = {};  ///< added ones, topmost first
};

SceneTree makeSceneTree(field::Aspect& aspect);

/// Inserts a node with this core right above the content.
const scene::Node& insertAboveContent(field::Aspect& aspect, SceneTree& tree, std::string name,
                                      const scene::NodeCore& core);

/// A placed node beside the lights, for a light's or a camera's beacon.
const scene::Node& addBeacon(field::Aspect& aspect, const SceneTree& tree, std::string name,
                             const math::dmat4& worldFromBeacon);

}  // namespace gnomon::client
