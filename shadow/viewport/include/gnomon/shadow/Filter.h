#pragma once

#include <span>
#include <string_view>

namespace gnomon::shadow {

/// A way to look maps up: GLSL, and what it needs around each page.
struct FilterInfo {
    std::string_view name = {};    ///< the word in configs and on the command line
    std::string_view source = {};  ///< authors, title, year
    /// Defines `float filteredShadow(int first, ShadowPoint point)`: 1 lit, 0 shadowed. The point's
    /// place is in texels of the map, its slope in depth a texel. May call `float pageCompare(int
    /// first, ShadowPoint point)`, the comparison interpolated between the four nearest texels.
    std::string_view glsl = {};
    /// Reach of the filter around the looked-up point, texels, each way: what must be drawn.
    float radiusTexels = 1.0F;
};

/// Every filter built in, sorted by name.
std::span<const FilterInfo> filters();
/// nullptr where there is none of that name.
const FilterInfo* findFilter(std::string_view name) noexcept;

/// GLSL of the maps' uniform block, for vertex and fragment shaders. Binding points are those of
/// ShadowMaps. Lights' maps stand one after the other, MAPS_PER_LIGHT of each.
std::string_view mapsGlsl() noexcept;
/// GLSL that declares pages and `shadowFactor()`, to stand after mapsGlsl() and before the
/// filter's.
std::string_view lookupGlsl() noexcept;

}  // namespace gnomon::shadow
