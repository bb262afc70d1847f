#pragma once

#include <gnomon/demo/Scene.h>

#include <cstdint>

namespace gnomon::demo {

/// A material, and how its texture is laid on.
struct Finish {
    Index material = 0;
    float uvPerMetre = 1.0F;
};

/// Everything the plaza is made of.
struct Materials {
    Finish paving = {};
    Finish travertine = {};
    Finish marble = {};
    Finish darkMarble = {};
    Finish plaster = {};
    Finish terracotta = {};
    Finish bronze = {};
    Finish gold = {};
    Finish iron = {};
    Finish bark = {};
    Finish wood = {};
    Finish grass = {};
    Finish roof = {};
    Finish water = {};
    Finish soil = {};
    Finish lamp = {};   ///< glows
    Finish spray = {};  ///< jets of water
    Finish gull = {};
    Finish leaves = {};   ///< cut out, both sides
    Finish needles = {};  ///< cut out, both sides
    Finish core = {};     ///< the dark inside of a cypress
    Finish banner = {};   ///< both sides
};

/// @param textureShrink  Divides the size of the textures, down to 16 texels a side.
Materials addMaterials(Scene& scene, std::uint64_t seed, std::uint32_t textureShrink);

}  // namespace gnomon::demo
