#pragma once

#include <cstddef>
#include <vector>

#include "gltf/Document.h"
#include "input/Report.h"

namespace gnomon::importer {

/// Deepest nesting of nodes that is accepted.
inline constexpr std::size_t maxNodeDepth = 1000;

/// The nodes of the default scene, every parent before its children.
struct GltfGraph {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> order = {};   ///< node numbers
    std::vector<std::size_t> parent = {};  ///< by node number; none: a root of the scene
    std::size_t depth = 0;                 ///< of the deepest; roots have 1
};

/// Checks that all nodes of the file form trees, without recursion, and returns those of the
/// default scene. Refuses cycles, nodes with two parents and trees deeper than maxNodeDepth.
GltfGraph gltfGraph(const GltfDocument& document, Report& report);

}  // namespace gnomon::importer
