#pragma once

#include <gnomon/client/Application.h>

#include <filesystem>
#include <functional>

#include "Shot.h"
#include "ViewOptions.h"

namespace gnomon::client {

/// The command line of `gnomon run`.
struct RunOptions {
    std::filesystem::path config = {};
    std::filesystem::path scene = {};  ///< empty: an empty scene
    std::optional<std::uint64_t> frames = {};
    std::filesystem::path path = {};
    ViewArguments view = {};
    std::vector<LightOption> lights = {};
    ShadowArguments shadow = {};
    std::string backend = "auto";
    bool local = false;
    std::filesystem::path key = {};  ///< empty: the config's, or the usual one
    std::optional<config::Cells> tile = {};
    std::filesystem::path out = {};
    std::filesystem::path json = {};
    std::filesystem::path trace = {};  ///< CSV, a line for each frame
    std::filesystem::path log = {};    ///< what is said on standard output, kept
    bool dryRun = false;
    /// What technique `auto` means, measured on what one server shows; empty: it is not measured.
    std::function<Choice(const ShotOptions&)> choose = {};
};

/// @throws Failure
int run(const RunOptions& options);

}  // namespace gnomon::client
