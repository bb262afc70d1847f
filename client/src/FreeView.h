#pragma once

#include <gnomon/client/SceneSetup.h>
#include <gnomon/scene/Window.h>

#include "Console.h"
#include "ViewOptions.h"

/// What `shot`, `truth` and `bench` share: a scene from a file, seen without a wall.
namespace gnomon::client {

struct LoadOptions {
    std::filesystem::path file = {};
    std::vector<LightOption> lights = {};  ///< replace the scene's
    double animationTime = 0.0;            ///< seconds into its animations
};
/// With a progress bar; what the importer warns of goes to the console. @throws Failure
PreparedScene loadScene(field::Aspect& aspect, Console& console, const LoadOptions& options);

/// Pixels of a picture whose size is not said.
inline constexpr std::array<int, 2> defaultViewSize{1024, 1024};

struct FreeViewOptions {
    ViewArguments view = {};
    config::Shadow shadow = {};
    int samples = 1;
    std::string server = {};  ///< whose the window is
};
/// A window with one viewport, that looks from where the options say, else from where the scene is
/// seen well.
field::Ref<scene::Window> addFreeView(field::Aspect& aspect, const PreparedScene& scene,
                                      const FreeViewOptions& options);

}  // namespace gnomon::client
