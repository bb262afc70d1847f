// The light that can reach a place at the most, from mean and variance of the depths around it:
// filtered like any picture, once a map. William Donnelly, Andrew Lauritzen. Variance Shadow Maps.
// 2006. Depths count from the middle of the range, which leaves their squares a bit more of a
// float. A plane has variance of its own; nothing is added but what floats cannot tell.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {
namespace {

const PyramidInfo moments{.channels = 2,
                          .texelsPerCell = 2,
                          .glsl = R"glsl(
// Of a depth of 0.
const vec4 nothing = vec4(-0.5, 0.25, 0.0, 0.0);
vec4 firstLevel(ivec2 cell) {
    vec4 depths = textureGather(page, vec3((vec2(cell * 2) + 2.0) * texel, layer)) - 0.5;
    return vec4(dot(depths, vec4(0.25)), dot(depths, depths) * 0.25, 0.0, 0.0);
}
)glsl",
                          .levels = momentLevelsGlsl()};

}  // namespace

FilterInfo describe_vsm() {
    return {.name = "vsm",
            .source = "Donnelly, Lauritzen 2006",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    float slope = abs(point.slope.x) + abs(point.slope.y);
    float here = point.place.z - 0.5 + slope * slackTexels;
    vec4 moments = momentsAround(first, point);
    float lit = litAtMost(moments.xy, here, 1e-6 + slope * slope * 0.25);
    return moments.x == unknown ? 1.0 : lit;
}
)glsl",
            .shared = momentsGlsl(),
            .pyramid = &moments,
            .leastTexels = 8.0F,
            .bleeds = true};
}

}  // namespace gnomon::shadow
