#pragma once

#include <gnomon/client/Lights.h>
#include <gnomon/client/Look.h>
#include <gnomon/client/Model.h>
#include <gnomon/field/ChangeList.h>

#include <optional>

/// What `run`, `shot`, `truth` and `bench` have in common: a file becomes a lit scene with a view.
namespace gnomon::client {

struct SceneOptions {
    std::filesystem::path file = {};  ///< empty: an empty scene
    /// Replace the file's own lights; empty: the file's own, else the default sun.
    std::vector<LightOption> lights = {};
    ProgressCallback progress = {};
    /// What importer::importScene() read of the file, to put one file into several aspects;
    /// nullptr: it is read.
    const field::ChangeList* imported = nullptr;
};

struct PreparedScene {
    SceneTree tree = {};
    std::optional<Model> model = {};  ///< nothing for an empty scene
    math::Box bounds = {};            ///< of what is drawn at rest, world; empty for an empty scene
    bool defaultSun = false;          ///< the default sun was added
};

/// Makes the scene in the aspect: tree, model, lights. Nothing of it is committed yet.
Result<PreparedScene> prepareScene(field::Aspect& aspect, const SceneOptions& options);
/// The same below a tree that is there already.
Result<PreparedScene> prepareScene(field::Aspect& aspect, const SceneTree& tree,
                                   const SceneOptions& options);

/// The lights that are on, topmost first: what `--light I` counts.
std::vector<field::Ref<scene::Node>> activeLights(const field::Aspect& aspect,
                                                  const PreparedScene& scene);

/// Where to look from unless told otherwise.
struct DefaultView {
    Look look = {};
    std::optional<double> fovy = {};  ///< the model's camera's, radians; nothing without a camera
};

/// The model's first camera, else a view that shows all of it through @p through.
/// @param focus  metres from the head to the screen; the scale then puts the scene's centre on the
///               screen. 0: scale 1.
DefaultView defaultView(const field::Aspect& aspect, const PreparedScene& scene,
                        const Opening& through, double focus = 0.0);

/// A camera without a room (for a single picture), with a beacon of its own.
const scene::PerspectiveCamera& addCamera(field::Aspect& aspect, const SceneTree& tree,
                                          const Look& look, double fovy, const DepthRange& range);

}  // namespace gnomon::client
