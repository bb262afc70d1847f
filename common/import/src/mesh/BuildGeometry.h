#pragma once

#include <gnomon/scene/Geometry.h>

#include <string_view>

#include "input/Report.h"
#include "mesh/MeshData.h"

namespace gnomon::importer {

/// Coordinates beyond this are taken for mistakes: their squares do not fit a float.
inline constexpr float largestCoordinate = 1e30F;

/// Makes the container of a mesh: drops what is not finite, joins equal vertices, recognizes closed
/// surfaces, cuts into chunks and orders vertices by first use. See Geometry for what it promises.
/// @param withTangents  the material has a normal map
/// @param where  names the mesh in warnings
/// @return nullptr where nothing is left to draw.
const scene::Geometry* buildGeometry(field::Aspect& aspect, MeshData mesh, bool withTangents,
                                     Report& report, std::string_view where);

}  // namespace gnomon::importer
