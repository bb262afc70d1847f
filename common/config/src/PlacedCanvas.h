#pragma once

#include <gnomon/config/Layout.h>

namespace gnomon::config {

/// canvas() with the place of what is wrong kept apart from the text.
tl::expected<Canvas, Finding> placedCanvas(const Screen& screen, Cells tileSize);

}  // namespace gnomon::config
