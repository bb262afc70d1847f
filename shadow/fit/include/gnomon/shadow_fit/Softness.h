#pragma once

#include <gnomon/math/BoxTree.h>
#include <gnomon/shadow_fit/Fit.h>

#include <span>
#include <string_view>

namespace gnomon::shadow_fit {

/// How far from a place filters look up what shadows it.
enum class Spread {
    none,      ///< at the place
    fixed,     ///< softnessOf() around it
    texels,    ///< half a kernel's width around it
    penumbra,  ///< as far as the light's extent and what casts give
};
struct FilterUse {
    std::string_view name = {};
    Spread spread = Spread::none;
    int pageTexels = shadow_fit::pageTexels;  ///< a side, at the most
    /// How far it goes, in what it spreads by: where kernels have tails.
    double tails = 1.0;
};
/// Every filter a technique can name. Their lookups are shadow's business.
std::span<const FilterUse> filterUses() noexcept;
/// nullptr where there is none of that name.
const FilterUse* findFilterUse(std::string_view name) noexcept;

/// Radius of fixed kernels, metres, where none is set: what the light's extent makes of an edge ten
/// metres away from what it shadows (parallel light) or halfway to it (others), but at least 5 cm.
double softnessOf(const LightShape& light) noexcept;

/// ShadowState::extent of a light.
double extentOf(const LightShape& light) noexcept;

/// How far around a place lookups go at the most, in units of the light's plane; 0 for
/// Spread::none.
/// @param softness   metres
/// @param share      half a kernel's width, a share of the map's side
/// @param receivers  of which some must be in front of the light
/// @param casters    boxes of what casts
double lookupReach(const FilterUse& filter, const LightShape& light, double softness, double share,
                   std::span<const math::dvec3> receivers, const math::BoxTree& casters);

}  // namespace gnomon::shadow_fit
