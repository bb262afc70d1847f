#pragma once

#include <filesystem>

#include "build/SceneBuilder.h"
#include "input/Files.h"

namespace gnomon::importer {

/// Reads any other format through Assimp: meshes, nodes, materials, lights. Refuses (throws
/// Failure) what Assimp refuses. Assimp may crash on hostile files: this process ends with it.
void readWithAssimp(const std::filesystem::path& file, Folder& folder, SceneBuilder& to);

}  // namespace gnomon::importer
