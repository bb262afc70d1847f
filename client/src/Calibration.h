#pragma once

#include <vector>

#include "AutoTechnique.h"
#include "Console.h"
#include "LocalSession.h"

namespace gnomon::client {

/// Tries techniques on what a session shows, and holds them against exact rays: what technique
/// `auto` chooses from. The windows are as they were before, but for the choice.
/// @param windows  with shadow viewports; the error is that of the first one's first light
/// @throws Failure
Choice calibrate(LocalSession& session, const std::vector<field::Ref<scene::Window>>& windows,
                 const Budget& budget, Console& console);

}  // namespace gnomon::client
