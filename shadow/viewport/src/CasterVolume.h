#pragma once

#include <gnomon/math/View.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// What is seen, as a map shows it: x and y in [-1, 1] within the map, z the reversed depth.
struct SeenInMap {
    std::vector<math::dvec3> points = {};
    /// Some of it is at or behind the light: it may be anywhere.
    bool anywhere = false;

    /// A light and how far around a place it is looked up: as ShadowState's.
    struct Around {
        math::dvec4 source{0.0};
        double reach = 0.0;
    };
    void project(const math::dmat4& clipFromWorld, std::span<const math::dvec3> seenWorld,
                 const Around& around);
};

/// What can cast into a page onto what is seen: between the page's sides, around the image of what
/// is seen, and not beyond it.
class CasterVolume {
public:
    /// @param sides    inner sides of the page in the world
    /// @param reach    of a lookup beyond the place it is for, in map units
    void enclose(const math::dmat4& clipFromWorld, std::span<const math::Plane> sides,
                 const SeenInMap& seen, double reach);

    /// Inner sides, world.
    std::span<const math::Plane> planes() const noexcept { return planes_; }
    /// Everything that casts onto what is seen now is within it. Has some play, so that a map that
    /// stays where it is serves a view that moves.
    bool serves(const SeenInMap& seen) const noexcept;

private:
    std::vector<math::Plane> planes_;
    std::vector<math::dvec3> lines_;  ///< a x + b y + c >= 0 inside, (a, b) unit, map units
    double leastDepth_ = 0.0;
    bool open_ = true;  ///< between the page's sides alone
};

}  // namespace gnomon::shadow
