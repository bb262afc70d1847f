#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::shadow {

/// How a cell is stored.
enum class Cell : std::uint8_t {
    rg16,     ///< two shares of 1, in 65535 steps
    rgba16f,  ///< four half floats
    rg32f,
    rgba32f
};
constexpr std::uint64_t bytesOf(Cell cell) noexcept {
    return cell == Cell::rg16 ? 4U : cell == Cell::rgba32f ? 16U : 8U;
}

/// What is made of each page after it was drawn: cells of texels, coarser from level to level.
struct PyramidInfo {
    Cell cell = Cell::rgba32f;
    int texelsPerCell = 4;  ///< a side, of the first level; a cell of the next has twice as many
    /// Together they define three functions. `vec4 firstLevel(ivec2 cell)`, from the page: texel
    /// (x, y) of `page`, layer `layer`, has its middle at (x + 1.5, y + 1.5) * `texel`. `vec4
    /// nextLevel(ivec2 cell)` of `level`, from level 0 of `cells`, four cells of the level before
    /// each. `vec4 kept(ivec2 cell)`, what lookups see of it, from the cells around it in level 0
    /// of `cells`, `side` each way.
    std::string_view glsl = {};
    std::string_view levels = {};
};

/// A way to look maps up: GLSL, and what it needs of each page.
struct FilterInfo {
    std::string_view name = {};    ///< the word in configs and on the command line
    std::string_view source = {};  ///< authors, title, year
    /// Defines `float filteredShadow(int first, ShadowPoint point)`: 1 lit, 0 shadowed. May call
    /// what lookupGlsl() has. Lookups stay within the light's reach of the point.
    std::string_view glsl = {};
    std::string_view shared = {};          ///< GLSL that stands before it: softGlsl()
    const PyramidInfo* pyramid = nullptr;  ///< what it reads of pages besides their depths
    /// How far around a place it reads the map, texels, where the light's reach is less.
    float leastTexels = 1.0F;
    bool bleeds = false;  ///< what is in shadow may be lit: it says how much may be lit at the most
    /// What it finds is blurred on the screen before anything is shaded with it. Its GLSL has a
    /// `float kernelTexels` besides: the kernel's radius in texels, of what was looked up.
    bool onScreen = false;
};

/// Every filter built in, sorted by name.
std::span<const FilterInfo> filters();
/// nullptr where there is none of that name.
const FilterInfo* findFilter(std::string_view name) noexcept;

/// GLSL of the maps' uniform block, for vertex and fragment shaders. Binding points are those of
/// ShadowMaps. Lights' maps stand one after the other, MAPS_PER_LIGHT of each.
std::string_view mapsGlsl() noexcept;
/// Bounds of the depths of each cell, above and below a plane: what softGlsl() reads.
const PyramidInfo& depthBounds() noexcept;
/// GLSL of filters that compare many texels, to stand after lookupGlsl(). Needs depthBounds().
std::string_view softGlsl() noexcept;
/// GLSL of filters that read moments of the depths, to stand after lookupGlsl().
std::string_view momentsGlsl() noexcept;
/// The levels of their pyramids. Of depths: needs `stored(x, y)`, a vec2, as they are kept; of
/// warped depths: needs `exponent`.
std::string_view varianceLevelsGlsl();
std::string_view exponentLevelsGlsl();
/// GLSL that declares pages and `shadowFactor()`, to stand after mapsGlsl() and before the
/// filter's.
std::string_view lookupGlsl() noexcept;

}  // namespace gnomon::shadow
