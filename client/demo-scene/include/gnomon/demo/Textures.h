#pragma once

#include <gnomon/demo/Image.h>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::demo {

/// A colour image and, for most, the normal map of the same surface (X right, Y up, linear).
struct Texture {
    Image colour = {};
    std::optional<Image> normal = {};
};

/// One procedural texture: how to make it, and how large a piece of surface it shows.
struct TextureInfo {
    const char* name = "";
    /// @param size  Texels a side; the picture is the same at any size, apart from its detail.
    Texture (*make)(std::uint64_t seed, std::uint32_t size) = nullptr;
    std::uint32_t size = 512;  ///< texels a side that show all of its detail
    float metres = 1.0F;       ///< one repeat; 0 for a picture that does not tile
};

/// Every texture of the plaza. All with metres > 0 join without a seam on all four sides.
std::span<const TextureInfo> textures();

Texture paving(std::uint64_t seed,
               std::uint32_t size);  ///< limestone slabs in courses of unequal length
Texture travertine(std::uint64_t seed,
                   std::uint32_t size);  ///< pale pitted stone, for the architecture
Texture marble(std::uint64_t seed,
               std::uint32_t size);  ///< grey-veined white, for the dial and the fountain
Texture plaster(std::uint64_t seed, std::uint32_t size);  ///< ochre wall
Texture terracotta(std::uint64_t seed,
                   std::uint32_t size);                  ///< with the rings of the potter's wheel
Texture bronze(std::uint64_t seed, std::uint32_t size);  ///< brown-gold with verdigris
Texture bark(std::uint64_t seed, std::uint32_t size);
Texture wood(std::uint64_t seed, std::uint32_t size);
Texture grass(std::uint64_t seed, std::uint32_t size);  ///< dry meadow
Texture roof(std::uint64_t seed,
             std::uint32_t size);  ///< courses of half-round tiles, down the v axis
Texture water(std::uint64_t seed, std::uint32_t size);  ///< small ripples
Texture leaves(std::uint64_t seed,
               std::uint32_t size);  ///< a twig of broad leaves, cut out by alpha
Texture needles(std::uint64_t seed, std::uint32_t size);  ///< a cypress spray, cut out by alpha
Texture banner(std::uint64_t seed, std::uint32_t size);   ///< red cloth with a golden sun

}  // namespace gnomon::demo
