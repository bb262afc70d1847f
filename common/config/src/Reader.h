#pragma once

#include <gnomon/config/Config.h>

#include <vector>

#include "Document.h"

namespace gnomon::config {

/// The configuration in a parsed file, grids expanded. Reports unknown and missing keys, wrong
/// types and broken rules; what it reports on keeps its default.
Config readConfig(const Node& root, std::vector<Finding>& findings);

}  // namespace gnomon::config
