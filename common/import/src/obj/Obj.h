#pragma once

#include <span>

#include "build/SceneBuilder.h"
#include "input/Files.h"

namespace gnomon::importer {

/// Reads a Wavefront OBJ file and its .mtl files. Refuses (throws Failure) what is malformed.
void readObj(std::span<const std::byte> file, Folder& folder, SceneBuilder& to);

}  // namespace gnomon::importer
