#pragma once

#include <span>

#include "build/SceneBuilder.h"
#include "input/Files.h"

namespace gnomon::importer {

/// Reads a PLY file, ASCII or binary. Refuses (throws Failure) what is malformed.
void readPly(std::span<const std::byte> file, Folder& folder, SceneBuilder& to);

}  // namespace gnomon::importer
