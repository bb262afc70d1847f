#pragma once

#include <gnomon/demo/Scene.h>

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::demo {

/// A glTF 2.0 binary file with everything in it; lights as KHR_lights_punctual.
/// @throws Failure limit, when it would pass the 4 GiB a GLB can have.
std::vector<std::uint8_t> toGlb(const Scene& scene);

/// A Wavefront OBJ file: positions in world space and faces, nothing else.
std::string toObj(const Scene& scene);

}  // namespace gnomon::demo
