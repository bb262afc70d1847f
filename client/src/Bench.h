#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ViewOptions.h"

namespace gnomon::client {

struct BenchOptions {
    std::filesystem::path scene = {};
    ViewArguments view = {};
    std::vector<LightOption> lights = {};
    std::vector<std::string> techniques = {};
    std::vector<int> mapSizes = {};
    std::string backend = "auto";
    int rounds = 50;
    bool dynamic = false;
    std::filesystem::path json = {};
    std::filesystem::path csv = {};
    std::filesystem::path report = {};  ///< a folder
};

/// Runs techniques in turn, frame by frame, so that a machine's mood hits all alike, and holds each
/// one's shadow factor against the ray-traced truth. @throws Failure
int bench(const BenchOptions& options);

}  // namespace gnomon::client
