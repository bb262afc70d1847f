#pragma once

#include <gnomon/math/Types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input/Report.h"
#include "mesh/MeshData.h"

namespace gnomon::importer {

/// A corner by numbers into the arrays of an ObjFile.
struct ObjCorner {
    static constexpr std::uint32_t none = 0xffffffffU;
    std::uint32_t position = none;
    std::uint32_t texCoord = none;
    std::uint32_t normal = none;
};

/// What one object (or group) has of one material.
struct ObjPart {
    std::string name = {};
    std::string material = {};
    std::vector<ObjCorner> triangles = {};  ///< three each
    std::vector<ObjCorner> lines = {};      ///< two each
    std::vector<ObjCorner> points = {};
};

/// A Wavefront OBJ file with its polygons cut into triangles. All corner numbers are in range;
/// coordinates may be not finite.
struct ObjFile {
    std::vector<math::vec3> positions = {};
    std::vector<Color8> colors = {};  ///< linear; empty or one a position
    std::vector<math::vec2> texCoords = {};
    std::vector<math::vec3> normals = {};
    std::vector<ObjPart> parts = {};
    std::vector<std::string> libraries = {};  ///< names of .mtl files
};

/// Refuses (throws) text that has no vertices or whose numbers cannot be read; faces with faults
/// are left out with a warning.
ObjFile parsedObj(std::string_view text, Report& report);

}  // namespace gnomon::importer
