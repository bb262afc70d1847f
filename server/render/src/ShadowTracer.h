#pragma once

#include <gnomon/shadow_fit/Fit.h>
#include <gnomon/truth/RayScene.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::render {

/// Shadow factors of the surfaces in a depth image, by rays to the lights, on several threads.
///
/// A light without extent is asked by one ray a pixel. To one with an extent 5 go from every pixel,
/// always to the same places of it: its middle and its rim. Pixels where they disagree, with each
/// other or with those of a pixel at most `reach` columns and rows away, ask 16 places, and where
/// these disagree 64, in steps of 4/255. So half-shadow that is less than a sliver of the light is
/// taken for none, and a caster that no ray of the first within reach meets is lost.
///
/// A factor depends on the surfaces within `reach` pixels and nothing else. Of those nearer to the
/// rim of the image it is not what a larger image would have: they are a margin.
class ShadowTracer {
public:
    static constexpr int reach = 2;  ///< pixels

    ShadowTracer();

    struct Surfaces {
        math::dmat4 clipFromWorld{1.0};
        glm::ivec2 size{0, 0};
        std::span<const float> depths =
            {};  ///< rows from the bottom up, reversed; 0: nothing there
    };
    /// An image of factors for each light, as the surfaces lie. Valid until the next call.
    std::span<const std::uint8_t> trace(const truth::RayScene& scene, const Surfaces& surfaces,
                                        std::span<const shadow_fit::LightShape> lights);

private:
    std::vector<math::dvec2> places_;  ///< of a light, in the order they are asked
    std::vector<std::uint8_t> seen_;  ///< by light and pixel: bit 0 a probe arrives, 1 one does not
    std::vector<std::uint8_t> factors_;
    unsigned threads_;
};

}  // namespace gnomon::render
