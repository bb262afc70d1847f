#pragma once

#include <gnomon/math/Types.h>

#include <cstdint>
#include <vector>

namespace gnomon::importer {

/// Triangles to test with. All faces turn outwards, counter-clockwise.
struct Shape {
    std::vector<math::vec3> positions = {};
    std::vector<std::uint32_t> indices = {};

    std::size_t triangles() const { return indices.size() / 3; }
    /// Adds another one's triangles, moved.
    void add(const Shape& other, const math::vec3& offset);
    /// Gives every triangle three vertices of its own.
    Shape unshared() const;
};

Shape cube();
/// Longitude and latitude; 2 * columns * (rows - 1) triangles.
Shape sphere(std::uint32_t columns, std::uint32_t rows);
/// A square of n x n cells in the xz plane, facing up.
Shape plane(std::uint32_t n);

}  // namespace gnomon::importer
