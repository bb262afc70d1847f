#pragma once

#include <functional>
#include <string>

namespace gnomon::gl {

/// What GLX_NV_swap_group offers for a window, or a test in its place.
/// Source: https://registry.khronos.org/OpenGL/extensions/NV/GLX_NV_swap_group.txt
struct SwapGroups {
    /// How many there may be; false where the driver cannot tell.
    std::function<bool(unsigned& groups, unsigned& barriers)> most = {};
    std::function<bool(unsigned group)> join = {};                    ///< the window; 0: none
    std::function<bool(unsigned group, unsigned barrier)> bind = {};  ///< 0: none
};

struct SwapGroupOutcome {
    bool joined = false;
    std::string text = {};  ///< for people: what it swaps with, or why with nothing
};

/// Joins group 1, whose windows swap at one refresh, and binds it to barrier 1, with which the
/// groups of all machines on a sync cable do. Without a barrier the windows of this machine swap
/// together.
SwapGroupOutcome joinSwapGroup(const SwapGroups& groups);

}  // namespace gnomon::gl
