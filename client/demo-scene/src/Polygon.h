#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace gnomon::demo {

/// Splits a counter-clockwise polygon into triangles by cutting ears.
///
/// A hole is given as a slit: the outline runs to the hole, clockwise round it, and back the same
/// way. Both sides of the slit become inner edges.
/// @pre The outline does not cross itself.
std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const glm::vec2> outline);

}  // namespace gnomon::demo
