#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "AutoTechnique.h"
#include "ViewOptions.h"

namespace gnomon::client {

struct ShotOptions {
    std::filesystem::path scene = {};
    ViewArguments view = {};
    std::vector<LightOption> lights = {};
    ShadowArguments shadow = {};
    std::string backend = "auto";
    int frames = 0;  ///< to time, after warm-up; 0: one picture, no timing
    bool dynamic = false;
    int light = 0;
    double animationTime = 0.0;  ///< seconds
    int samples = 1;
    std::filesystem::path wall = {};  ///< a wall's config instead of a view
    std::optional<std::array<int, 2>> tile =
        {};  ///< pixels of each of its tiles instead of the config's
    std::optional<config::Eye> eyeSide = {};
    std::filesystem::path out = {};
    std::filesystem::path shadowFactor = {};
    std::filesystem::path json = {};
};

/// One process, one picture. @throws Failure
int takeShot(const ShotOptions& options);
/// What technique `auto` means for what would be shot. @throws Failure
Choice chooseTechnique(const ShotOptions& options);

}  // namespace gnomon::client
