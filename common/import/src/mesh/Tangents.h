#pragma once

#include "mesh/MeshData.h"

namespace gnomon::importer {

/// Tangents for a normal map, from normals and texture coordinates: each vertex gets the sum of its
/// faces' directions of growing u, made orthogonal to the normal. A vertex between mirrored and
/// unmirrored faces becomes two.
/// Source: Eric Lengyel. Computing Tangent Space Basis Vectors for an Arbitrary Mesh. 2001.
/// @pre triangles, with normals and texture coordinates
void addTangents(MeshData& mesh);

/// Makes given tangents unit vectors with w = 1 or -1; one that is no direction becomes any that is
/// orthogonal to the normal.
void repairTangents(MeshData& mesh);

}  // namespace gnomon::importer
