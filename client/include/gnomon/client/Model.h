#pragma once

#include <gnomon/client/SceneTree.h>
#include <gnomon/scene/Imported.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::client {

/// Progress of something slow: share done, 0..1, and what it is at.
using ProgressCallback = std::function<void(double share, const std::string& what)>;

/// A file's content in the application's aspect.
struct Model {
    std::string source = {};  ///< the file's name
    field::Ref<scene::Node> root = {};
    std::vector<field::Ref<scene::PerspectiveCamera>> cameras = {};
    std::vector<field::Ref<scene::Animation>> animations = {};
    std::vector<field::Ref<scene::AnimationPose>> poses = {};
    std::vector<field::Ref<scene::Node>> lights = {};  ///< nodes whose core is a light
    math::Box bounds = {};                             ///< in the model's root's space
    std::uint64_t triangles = 0;
    std::vector<std::string> warnings = {};
};

/// Takes an importer's list into the aspect and puts its root below the tree's content. A list that
/// is not sound (Errc::protocol) leaves the aspect as it was.
Result<Model> adoptModel(field::Aspect& aspect, const SceneTree& tree,
                         const field::ChangeList& imported);
/// Imports a file (in a process of its own) and adopts it.
Result<Model> loadModel(field::Aspect& aspect, const SceneTree& tree,
                        const std::filesystem::path& file, const ProgressCallback& progress = {});

/// Switches the model's own lights off; those added to the tree stay.
void switchOffLights(field::Aspect& aspect, const Model& model);
/// True where one of the model's lights is on.
bool hasLight(const field::Aspect& aspect, const Model& model);

}  // namespace gnomon::client
