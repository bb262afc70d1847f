#pragma once

#include <gnomon/math/Types.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::importer {

/// Polygons with more corners than this are refused: ear clipping is quadratic.
inline constexpr std::size_t maxPolygonCorners = 10000;

/// Cuts a polygon into corners - 2 triangles, appended to @p out as numbers into @p polygon.
/// Concave ones by ear clipping, seen along their normal; where no ear is left (the polygon crosses
/// itself), the rest is cut as a fan. Fewer than three corners give nothing.
/// @pre at most maxPolygonCorners
void triangulate(std::span<const math::vec3> polygon, std::vector<std::uint32_t>& out);

}  // namespace gnomon::importer
