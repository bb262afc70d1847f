#pragma once

#include <span>

#include "build/SceneBuilder.h"
#include "input/Files.h"

namespace gnomon::importer {

/// Reads a .gltf or .glb file. Refuses (throws Failure) what is malformed.
void readGltf(std::span<const std::byte> file, Folder& folder, SceneBuilder& to);

}  // namespace gnomon::importer
