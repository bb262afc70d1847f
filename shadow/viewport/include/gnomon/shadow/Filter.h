#pragma once

#include <span>
#include <string_view>

namespace gnomon::shadow {

/// A way to look maps up: GLSL, and what it needs around each page.
struct FilterInfo {
    std::string_view name = {};    ///< the word in configs and on the command line
    std::string_view source = {};  ///< authors, title, year
    /// Defines `float filteredShadow(uint map, vec3 q)`: q.xy in [0,1]^2 of the map, q.z its
    /// reversed depth, already offset; 1 lit, 0 shadowed. May call `float pageCompare(uint map,
    /// vec2 texel, float depth)`, the bilinear comparison at a position in texels.
    std::string_view glsl = {};
    /// Reach of the filter around the looked-up point, texels: what the depth offset allows for.
    float radiusTexels = 1.0F;
};

/// Every filter built in, sorted by name.
std::span<const FilterInfo> filters();
/// nullptr where there is none of that name.
const FilterInfo* findFilter(std::string_view name) noexcept;

/// GLSL that declares the maps, pages and `shadowFactor()`, to stand before the filter's. Binding
/// points are those of ShadowMaps.
std::string_view lookupGlsl() noexcept;

}  // namespace gnomon::shadow
