#pragma once

#include "Glfw.h"
#include "SwapGroup.h"

namespace gnomon::gl {

/// Those of the driver for @p window, whose context is current; empty where it has none, or no GLX.
/// For as long as the window lives.
SwapGroups glxSwapGroups(GLFWwindow* window);

}  // namespace gnomon::gl
