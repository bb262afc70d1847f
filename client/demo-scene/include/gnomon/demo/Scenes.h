#pragma once

#include <gnomon/demo/Scene.h>
#include <gnomon/demo/Sun.h>

#include <cstdint>

namespace gnomon::demo {

/// A Mediterranean square in the late afternoon round a monumental sundial: 60 m across, 120 to
/// 250 thousand triangles, one sun, three spot lights, things that move, a camera named "view".
/// The seed changes plants, textures and small placements, not the architecture.
/// @param textureShrink  Divides the size of the textures (> 0): textures take most of the time.
Scene plaza(std::uint64_t seed, std::uint32_t textureShrink = 1);

/// The plaza's time of day, and the direction of north there: radians from -Z towards +X.
SunTime plazaTime();
double plazaNorth();

/// A test scene for shadow accuracy: 240 x 240 m of ground, pillars, spheres, a fence of 6 cm
/// slats and leafy trees, 113,904 triangles. One material, no lights.
Scene grove(std::uint64_t seed);

}  // namespace gnomon::demo
