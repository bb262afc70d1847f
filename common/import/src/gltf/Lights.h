#pragma once

#include <optional>
#include <vector>

#include "build/SceneBuilder.h"
#include "gltf/Document.h"

namespace gnomon::importer {

/// KHR_lights_punctual and cameras: what a node shows of them.
class GltfDevices {
public:
    GltfDevices(const GltfDocument& document, Report& report);

    /// Adds the node's light and camera, if it has any; @p node is the scene's node for it.
    void add(const JsonView& json, const scene::Node& node, const math::dmat4& worldFromNode,
             SceneBuilder& to);

private:
    std::optional<LightDraft> light(const JsonView& json);
    std::optional<CameraDraft> camera(const JsonView& json);

    Report& report_;
    std::vector<JsonView> lights_, cameras_;
};

}  // namespace gnomon::importer
