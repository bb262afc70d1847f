#pragma once

#include <string>

namespace gnomon::gl {

/// Opens windows on the virtual display, shows pictures in them, sends them input, and prints what
/// the display shows and which events arrive. @throws Failure.
/// @param screenshot  The XWD file in which Xvfb keeps what it shows.
void probeWindows(const std::string& screenshot);

}  // namespace gnomon::gl
