// The light that can reach a place at the most, from mean and variance of the depths around it:
// filtered like any picture, once a map. William Donnelly, Andrew Lauritzen. Variance Shadow Maps.
// 2006. Depths count from the middle of the range, which leaves their squares a bit more of a
// float. A plane has variance of its own; nothing is added but what floats cannot tell.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {
namespace {

const PyramidInfo vsmMoments{.cell = Cell::rg32f,
                             .texelsPerCell = 2,
                             .glsl = "#define stored vec2\n",
                             .levels = varianceLevelsGlsl()};

}  // namespace

FilterInfo describe_vsm() {
    return {.name = "vsm",
            .source = "Donnelly, Lauritzen 2006",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    vec4 moments = momentsAround(first, point, footprintOf(first, point));
    float lit = litByVariance(point, moments.xy, 1e-6);
    return moments.x == unknown ? 1.0 : lit;
}
)glsl",
            .shared = momentsGlsl(),
            .pyramid = &vsmMoments,
            .leastTexels = 8.0F,
            .bleeds = true};
}

}  // namespace gnomon::shadow
