#pragma once

#include <gnomon/image/Image.h>
#include <gnomon/math/View.h>
#include <gnomon/truth/LightSampler.h>
#include <gnomon/truth/RayScene.h>

#include <functional>

namespace gnomon::truth {

/// Values of a shadow factor image that are no factors.
inline constexpr std::uint8_t noSurface = 128;
/// A surface is counted where its geometric normal and the light make more than this cosine.
inline constexpr double leastCosine = 0.05;

struct TruthOptions {
    int width = 1024;  ///< pixels
    int height = 1024;
    int samples = 1;  ///< of the light, each pixel; 1: its centre
    std::function<void(double share)> progress = {};
};

struct Truth {
    /// One channel: 255 lit, 0 shadowed or outside a spot's cone; 128 where there is no surface or
    /// it faces away (leastCosine). A factor that rounds to 128 is written 127.
    image::Image factor = {};
    std::uint64_t counted = 0;   ///< pixels that are not 128
    std::uint64_t penumbra = 0;  ///< of them, those with a factor between 0 and 1
    double rootMeanWidth = 0.0;  ///< of the 95 % intervals' half widths over counted pixels
    double largestWidth = 0.0;   ///< the largest of them
};

/// One ray a pixel centre, and from there rays to the light. With more samples than one the
/// interval of each pixel is the binomial one, which stratified samples stay within.
Truth shadowTruth(const RayScene& scene, const math::View& view,
                  const shadow_fit::LightShape& light, const TruthOptions& options);

}  // namespace gnomon::truth
