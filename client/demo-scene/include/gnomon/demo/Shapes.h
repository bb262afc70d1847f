#pragma once

#include <gnomon/demo/Mesh.h>

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

/// Solids to build the scenes from. Each is watertight with outward winding unless its comment
/// says otherwise: corners that meet have bit-equal positions. Metres, radians, Y up.
namespace gnomon::demo {

/// Normals from the faces: faces that meet at an angle of less than @p crease (radians) are
/// smooth across their common corner. Also welds.
Mesh shaded(const Mesh& mesh, float crease = 0.6F);

/// Where a parametric surface is, and its texture coordinates.
using GridFunction = std::function<Vertex(int row, int column)>;

/// Adds rows x columns quads, without normals. Seen from outside, columns grow to the right and
/// rows upwards.
/// @param wrap  The last column of quads ends at column 0's positions.
void addGrid(Mesh& mesh, int rows, int columns, bool wrap, const GridFunction& at);

/// A box whose edges are cut at 45 degrees by @p bevel metres (0: sharp).
Mesh box(const glm::vec3& low, const glm::vec3& high, float uvPerMetre, float bevel = 0.0F);

/// A counter-clockwise outline in x and y, extruded from z = low to high. Slits make holes.
Mesh prism(std::span<const glm::vec2> outline, float low, float high, float uvPerMetre);

struct LatheOptions {
    int segments = 32;
    float uvPerMetre = 1.0F;
    float crease = 0.6F;  ///< radians, see shaded()
};

/// A profile of (radius, height), turned about Y. It runs counter-clockwise with the radius to
/// the right: bottom centre, out, up, and back to the top centre. Closed if both ends have
/// radius 0 or are the same point.
Mesh lathe(std::span<const glm::vec2> profile, const LatheOptions& options);

/// Part of a lathe with flat ends.
/// @param profile  Closed counter-clockwise outline of (radius, height), last point not repeated.
/// @param from,to  Site angles, see onCircle(); to - from in (0, 2 pi).
Mesh arc(std::span<const glm::vec2> profile, float from, float to, const LatheOptions& options);

/// A round tube with flat ends along @p path, of one radius a point.
Mesh tube(std::span<const glm::vec3> path, std::span<const float> radii, int sides,
          float uvPerMetre);

/// A ring round Y.
Mesh torus(float radius, float thickness, int segments, int sides, float uvPerMetre);

Mesh sphere(float radius, int segments, int rings, float uvPerMetre);

/// The point at @p angle from straight ahead (-Z), positive to the right (+X).
glm::vec3 onCircle(float radius, float angle, float height = 0.0F);

/// Turns -Z into onCircle(1, angle).
glm::mat4 turned(float angle);

/// A profile of points with each corner of it replaced by a short curve through it.
std::vector<glm::vec2> rounded(std::span<const glm::vec2> profile, int steps);

}  // namespace gnomon::demo
