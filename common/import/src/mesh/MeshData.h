#pragma once

#include <gnomon/math/Types.h>
#include <gnomon/scene/Geometry.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::importer {

using Color8 = std::array<std::uint8_t, 4>;

/// A mesh as a reader found it. Every vertex array is empty or as long as `positions`; every index
/// is below that length (readers see to it); two indices a line, three a triangle.
struct MeshData {
    scene::Primitive primitive = scene::Primitive::triangles;
    std::vector<math::vec3> positions = {};
    std::vector<math::vec3> normals = {};
    std::vector<math::vec2> texCoords = {};  ///< v = 0 is the image's top row
    std::vector<math::vec4> tangents = {};
    std::vector<Color8> colors = {};  ///< linear
    std::vector<std::uint32_t> indices = {};
};

/// Corners of one primitive.
constexpr std::size_t cornersOf(scene::Primitive primitive) noexcept {
    switch (primitive) {
        case scene::Primitive::points:
            return 1;
        case scene::Primitive::lines:
            return 2;
        default:
            return 3;
    }
}

}  // namespace gnomon::importer
