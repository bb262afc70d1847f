#include "SwapGroup.h"

#include <fmt/core.h>

namespace gnomon::gl {

SwapGroupOutcome joinSwapGroup(const SwapGroups& groups) {
    unsigned mostGroups = 0;
    unsigned mostBarriers = 0;
    if (!groups.most || !groups.most(mostGroups, mostBarriers) || mostGroups == 0)
        return {.text = "the driver offers no swap groups (GLX_NV_swap_group)"};
    if (!groups.join(1)) return {.text = "the driver lets the window into no swap group"};
    if (mostBarriers == 0)
        return {.joined = true,
                .text =
                    "swaps with the windows of this machine (swap group 1); there is no "
                    "barrier with others: no sync hardware"};
    if (!groups.bind(1, 1))
        return {.joined = true,
                .text =
                    "swaps with the windows of this machine (swap group 1); the driver binds "
                    "no barrier"};
    return {.joined = true, .text = "swaps with all machines (swap group 1, barrier 1)"};
}

}  // namespace gnomon::gl
