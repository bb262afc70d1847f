#pragma once

#include <filesystem>

#include "build/SceneBuilder.h"

namespace gnomon::importer {

/// Reads a model of any known format into @p to. Refuses (throws Failure) what cannot be used; the
/// text does not name the file.
void readModel(const std::filesystem::path& file, SceneBuilder& to);

}  // namespace gnomon::importer
