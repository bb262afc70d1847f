#pragma once

#include <gnomon/shadow_fit/Fit.h>

#include <cstdint>

namespace gnomon::truth {

/// The points of a light that a surface point may see. Distances are metres; a parallel light is
/// infinitely far away.
class LightSampler {
public:
    /// @param origin  what positions given here are relative to, in the world
    LightSampler(const shadow_fit::LightShape& light, const math::dvec3& origin);

    struct Ray {
        math::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, toward the light
        double reach = 0.0;                    ///< metres; infinite for a parallel light
    };
    bool hasExtent() const noexcept { return light_.extent > 0.0; }
    /// Toward the light's centre.
    Ray centre(const math::dvec3& from) const;
    /// Toward a point of the light: of a sun's disk by solid angle, of a spot's disk by area, of a
    /// sphere by the solid angle it is seen under.
    /// @param u  uniform in [0, 1)^2
    Ray sample(const math::dvec3& from, math::dvec2 u) const;
    /// The same toward a place in the unit disk, whose areas are the light's.
    Ray toward(const math::dvec3& from, math::dvec2 disk) const;
    /// False outside a spot's cone, seen from its centre: no light arrives there at all.
    bool shinesAt(const math::dvec3& position) const;

private:
    shadow_fit::LightShape light_;
    math::dvec3 position_{0.0};
    math::dvec3 u_{1.0, 0.0, 0.0};
    math::dvec3 v_{0.0, 1.0, 0.0};
    double cosineOfExtent_ = 1.0;
    double cosineOfCone_ = -1.0;
};

/// The i-th of a pixel's points in [0, 1)^2: the first two dimensions of Sobol's sequence,
/// scrambled by the pixel. Any power of two of them from 0 on is stratified in every elementary
/// interval. Source: Ilya Sobol. 1967; scrambling: Thomas Kollig, Alexander Keller. Efficient
/// Multidimensional Sampling. 2002.
math::dvec2 stratified(std::uint32_t i, std::uint32_t pixel) noexcept;

/// The i-th of n places in the unit disk that are spread evenly over it: seen from any side no line
/// meets many, so that shadows of straight edges have few steps. No prefix is even by itself.
/// Source: Helmut Vogel. A Better Way to Construct the Sunflower Head. 1979.
math::dvec2 sunflower(std::uint32_t i, std::uint32_t n) noexcept;

}  // namespace gnomon::truth
