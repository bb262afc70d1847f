#pragma once

#include <gnomon/demo/Mesh.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::demo {

/// What is wrong with a mesh that should bound solids; vertices at one place count as one.
struct Topology {
    std::size_t unmatchedEdges = 0;    ///< without just one partner in the opposite direction
    std::size_t flatTriangles = 0;     ///< without area
    std::size_t contraryNormals = 0;   ///< corners whose normal leaves the back of the face
    std::vector<double> volumes = {};  ///< of each connected piece, cubic metres
};

Topology examined(const Mesh& mesh);

}  // namespace gnomon::demo
