#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "../ViewOptions.h"

/// What `gnomon bench` compares, as values.
namespace gnomon::client {

/// A sun by where one looks, whatever the scene: for views of scenes that are not known in advance.
struct RelativeSun {
    double azimuth = 0.0;    ///< from behind the eye to the right, radians; pi: ahead
    double elevation = 0.6;  ///< above the horizon, radians
    double angle = 0.0;      ///< angular radius of its disk, radians
    friend bool operator==(const RelativeSun&, const RelativeSun&) = default;
};
Sun sunSeenFrom(const Look& look, const RelativeSun& sun);

/// A named look at a scene, with lights. What it leaves out is the scene's own, as of `shot`.
struct BenchView {
    std::string name = "view";
    /// Only for the scene whose file is called that, with or without its suffix; empty: for any.
    std::string scene = {};
    ViewArguments view = {};  ///< without a size
    std::vector<LightOption> lights = {};
    std::optional<RelativeSun> sun = {};  ///< instead of lights

    bool fits(const std::string& sceneFile) const;
};

/// One way of making shadows.
struct Variant {
    std::string label = "std";   ///< how it is called beside others; without the map's size
    config::Shadow shadow = {};  ///< with a map size
    int mapSize() const { return shadow.mapSize.value_or(0); }
};
Variant variant(const std::string& technique, int mapSize);

enum class Motion {
    still,   ///< what was drawn before may serve again
    moving,  ///< everything moves a little in every frame
};
const char* name(Motion motion) noexcept;

/// What is compared with each other, from some views: one table a scene, view, size and motion.
struct Chapter {
    std::string name = {};  ///< empty: there is only this one
    std::string about = {};
    std::vector<Variant> variants = {};  ///< ratios are to the first
    std::vector<BenchView> views = {};
    std::vector<std::array<int, 2>> sizes = {};  ///< windows, pixels
    std::vector<Motion> motions = {Motion::still};
    int flickerFrames = 0;  ///< of each path; 0: flicker is not measured
};

/// Techniques that are built in.
struct Registry {
    std::vector<std::string> fits = {};
    std::vector<std::string> filters = {};
    std::vector<std::string> others = {};  ///< that have no map: ray, volume ...
};

/// What the command line says; empty lists and nothing: not given.
struct PlanOptions {
    std::string sweep = {};
    std::vector<std::string> techniques = {};
    std::vector<int> mapSizes = {};
    std::vector<std::array<int, 2>> sizes = {};
    std::vector<Motion> motions = {};
    std::vector<BenchView> views = {};
    std::optional<int> flickerFrames = {};
};

/// The names that `--sweep` takes.
std::vector<std::string> sweepNames();
/// Techniques times map sizes times views ...; a sweep's, with what was given in place of its own.
/// Techniques and options that are not built in are left out of a sweep.
/// Errors (Errc::config): no such sweep, or an option that it does not take.
Result<std::vector<Chapter>> chaptersOf(const PlanOptions& options, const Registry& registry);

}  // namespace gnomon::client
