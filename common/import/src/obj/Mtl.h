#pragma once

#include <gnomon/math/Types.h>

#include <map>
#include <string>
#include <string_view>

#include "input/Report.h"

namespace gnomon::importer {

/// A material of an .mtl file. Maps are file names as written, '\' turned into '/'.
struct MtlMaterial {
    math::dvec3 diffuse{0.8};
    math::dvec3 specular{0.0};
    math::dvec3 emissive{0.0};
    double shininess = 32.0;
    double alpha = 1.0;
    std::string diffuseMap = {};
    std::string alphaMap = {};
    std::string normalMap = {};  ///< `norm`: a tangent-space normal map
    std::string bumpMap = {};    ///< `map_bump`: a height map, or in fact a normal map
    double bumpScale = 1.0;      ///< its -bm
    std::string emissiveMap = {};
};

using MtlLibrary = std::map<std::string, MtlMaterial, std::less<>>;

/// Adds a .mtl file's materials; lines that cannot be read are left out with a warning.
/// @param name  of the file, for warnings
void parseMtl(std::string_view text, const std::string& name, MtlLibrary& to, Report& report);

}  // namespace gnomon::importer
