#pragma once

#include <gnomon/config/Config.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon::client {

/// What technique `auto` keeps to.
struct Budget {
    std::optional<double> frameMs = {};  ///< milliseconds a frame
    std::optional<double> error = {};    ///< percent, as Measured::error
};
Budget budgetOf(const config::Shadow& shadow) noexcept;

/// A technique, and what it costs here.
struct Measured {
    std::string technique = {};
    int mapSize = 0;
    bool quality = false;  ///< quality mode: more samples
    double ms = 0.0;       ///< median frame
    double error = 0.0;  ///< percent: wrong pixels, or RMSE of the factor of a light with an extent
};

struct Choice {
    Measured chosen = {};
    std::string why = {};  ///< a sentence for people
};
/// With a frame budget the least error within it, else the fastest there is; with an error budget
/// the fastest within it, else the least error there is; with both, the least error within both
/// budgets, else as with the frame budget alone. @pre Something was measured.
Choice choose(const std::vector<Measured>& measured, const Budget& budget);

/// What is tried: techniques without a filter, or with the one for lights with an extent.
/// @param quality  quality mode is asked for; else it is tried where more samples are of use
std::vector<Measured> candidates(bool extent, bool quality);

}  // namespace gnomon::client
