#pragma once

#include <gnomon/math/Types.h>

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/MeshData.h"

namespace gnomon::importer {

/// Cosine of the angle between two faces from which on the edge between them is a sharp one: 60
/// deg.
inline constexpr float creaseCosine = 0.5F;

/// Smooth normals, one for each corner of each triangle: the area-weighted mean of the faces around
/// the corner's place that are within the crease angle of its own face. Corners of a face without
/// area get their neighbours' mean, or +z where there are none.
std::vector<math::vec3> creasedNormals(std::span<const math::vec3> positions,
                                       std::span<const std::uint32_t> corners);

/// Gives every corner a vertex of its own, so that corners can differ in their normals.
void unshareVertices(MeshData& mesh);

/// Puts each face's normal into its corners, which must not be shared (see unshareVertices).
void addFlatNormals(MeshData& mesh);

/// Makes normals unit vectors; one that is zero or not finite becomes the mean of its faces'.
void repairNormals(MeshData& mesh);

/// A face's normal, length = twice its area; in double, for coordinates up to 1e30.
math::dvec3 areaNormal(const math::vec3& a, const math::vec3& b, const math::vec3& c) noexcept;

/// Unit vector along @p v, or @p otherwise where v has no direction.
math::vec3 unitOr(const math::dvec3& v, const math::vec3& otherwise) noexcept;

}  // namespace gnomon::importer
