#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Plan.h"

namespace gnomon::client {

struct PeerOptions {
    std::filesystem::path program = {};  ///< empty: gnomon-osg-peer beside this program, if there
    std::vector<std::string> techniques = {};  ///< empty: the better ones of what it has
    bool off = false;
};

struct BenchOptions {
    std::vector<std::filesystem::path> scenes = {};  ///< none: the project's own plaza is made
    std::vector<Chapter> chapters = {};
    std::string backend = "auto";
    int frames = 50;
    std::filesystem::path path = {};  ///< of the eye, for flicker
    PeerOptions peers = {};
    std::filesystem::path json = {};
    std::filesystem::path csv = {};
    std::filesystem::path report = {};  ///< a folder
};

/// Holds each chapter's variants against each other and against the ray-traced truth, from each
/// view of each scene. @throws Failure
int bench(const BenchOptions& options);

}  // namespace gnomon::client
