#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/math/View.h>
#include <gnomon/shadow_fit/Receivers.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::shadow_fit {

/// Texels a side of a page: what a shadow map is drawn, kept and skipped by. A map is as many whole
/// pages as it needs, or a smaller single one.
inline constexpr int pageTexels = 1024;

/// Of all lights of a fit group: pages, the layers an array texture of OpenGL 4.5 has at the least,
/// and maps, what a lookup's uniform block holds.
inline constexpr int mostPages = 2048;
inline constexpr int mostMaps = 128;

enum class LightKind { directional, spot, point };

/// A light as a fit sees it, in world space and metres.
struct LightShape {
    LightKind kind = LightKind::directional;
    math::dvec3 position{0.0};              ///< spot and point
    math::dvec3 direction{0.0, -1.0, 0.0};  ///< unit, from the light into the scene
    double halfAngle = 0.785;               ///< of a spot's cone, radians, < pi/2
    double range = 0.0;                     ///< beyond it nothing is lit; 0: unlimited
    /// What it shines from: angular radius of a directional light's disk, radians; radius of a
    /// spot's disk or a point light's sphere, metres. 0: no extent.
    double extent = 0.0;
};

/// Half the angle of the widest cone a point light's single map shows, radians: 75 degrees.
inline constexpr double widestOfPoint = 1.3089969389957472;
/// A point light as the spot that sees what is seen: the narrowest cone around it, or, where that
/// is wider than widestOfPoint, one toward its middle. What is outside it is lit.
LightShape spotThatSees(const LightShape& point, std::span<const math::dvec3> seen);

/// Metres from the origin beyond which nothing is shadowed, and the least a map is wide: what
/// floats on the GPU can hold, squares and cubes of it doubles here.
inline constexpr double farthestPlace = 1e30;
inline constexpr double narrowestMap = 1e-30;
/// Neither farther away than that, nor no number.
inline bool isPlace(const math::dvec3& p) noexcept {
    return std::abs(p.x) <= farthestPlace && std::abs(p.y) <= farthestPlace &&
           std::abs(p.z) <= farthestPlace;
}

/// The light with a unit direction and angles in range; nothing where it has no place or direction.
std::optional<LightShape> usableLight(const LightShape& light) noexcept;

/// What an application can set of the fits. Each fit reads what concerns it.
struct FitSettings {
    /// trapez: the share of the view's depth, from the front, that gets four fifths of the map.
    double range = 0.3;
    int cascades = 4;  ///< csm: 2 to 8
};

struct FitInput {
    LightShape light = {};
    /// What the fit group sees: all eyes, whole screens.
    std::span<const math::View> views = {};
    /// What of the scene that is, and is lit: what a map must hold. Nothing: no map.
    const Receivers& receivers;
    /// Points of what is seen, each for an equal share of the picture, weighed for this light.
    std::span<const Sample> samples = {};
    math::Box scene = {};  ///< bounds of all casters and receivers
    int mapSize = 512;  ///< texels a side; of fits with several maps, as many in all as one of it
    FitSettings settings = {};
    /// How far lookups go around a place, in units of the light's plane: maps hold that much more.
    double reach = 0.0;
};

/// One map's light camera.
struct FittedMap {
    /// Clip space of the map from world. Depth reversed: 1 at the near side. Casters nearer to the
    /// light than that are clamped when the map is drawn. w >= 1 for parallel light, > 0 for
    /// others, wherever the map is looked up. Finite always.
    math::dmat4 clipFromWorld{1.0};
};

struct Fitted {
    std::vector<FittedMap> maps = {};  ///< none: no visible receiver, no shadow to compute
    int mapSize = 0;                   ///< texels a side of each map; 0: as in the input
    bool degenerate = false;           ///< the plain fit was used instead
};

/// A way to choose light frusta: a pure function. Its input is as fitted() leaves it.
struct FitInfo {
    std::string_view name = {};    ///< the word in configs and on the command line
    std::string_view source = {};  ///< authors, title, year
    Fitted (*fit)(const FitInput&) = nullptr;
    /// Receivers that nothing shadows are left out, so that its maps are finer and move with what
    /// casts; else they stay where they are while things move in them.
    bool shadowedOnly = false;
    bool sampled = false;  ///< reads the samples; else there are none
    /// While the view moves a little, its maps' texels stay where they are in the world, until a
    /// size or a split takes a step.
    bool stable = false;
};

/// Every fit built in, sorted by name.
std::span<const FitInfo> fits();

/// What a fit makes of any input. Fits are called through this alone: views, samples, casters and
/// settings that are not finite are left out, and what a fit makes is looked at; where it is not
/// finite as the floats of the GPU, the plain fit is used, and where that is not either, or the
/// light has no place, there is no map. Both are marked as degenerate.
Fitted fitted(const FitInfo& info, const FitInput& input);

/// `FIT[+FILTER]` taken apart. A filter alone means std+filter; "none" and "ray" need neither.
struct TechniqueName {
    std::string fit = {};
    std::string filter = {};
    bool traced = false;  ///< by rays
    bool none() const noexcept { return fit.empty(); }
};
/// Errors (Errc::config) name the words that would have done.
Result<TechniqueName> parseTechnique(std::string_view text,
                                     std::span<const std::string_view> filters);

/// Two unit vectors that with @p axis (unit) make a right-handed orthonormal base.
/// Source: Tom Duff et al. Building an Orthonormal Basis, Revisited. 2017.
std::pair<math::dvec3, math::dvec3> perpendicular(const math::dvec3& axis) noexcept;

}  // namespace gnomon::shadow_fit
