// Variance shadow maps of depths that an exponential warps, one way and the other: light bleeds
// less, since the warped distance of casters to each other is small beside that to what they
// shadow. Andrew Lauritzen, Michael McCool. Layered Variance Shadow Maps. 2008.
// With twice the exponent squares would still fit into a float, but planes that the light grazes
// would be too steep for their own mean.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {
namespace {

const PyramidInfo moments{.channels = 4,
                          .texelsPerCell = 2,
                          .glsl = R"glsl(
// Of a depth of 0.
const vec4 nothing = vec4(exp(-20.0), exp(-40.0), -exp(20.0), exp(40.0));
vec4 firstLevel(ivec2 cell) {
    vec4 depths = textureGather(page, vec3((vec2(cell * 2) + 2.0) * texel, layer)) - 0.5;
    vec4 up = exp(40.0 * depths), down = -exp(-40.0 * depths);
    return 0.25 * vec4(dot(up, vec4(1.0)), dot(up, up), dot(down, vec4(1.0)), dot(down, down));
}
)glsl",
                          .levels = momentLevelsGlsl()};

}  // namespace

FilterInfo describe_evsm() {
    return {.name = "evsm",
            .source = "Lauritzen, McCool 2008",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    float slope = abs(point.slope.x) + abs(point.slope.y);
    float here = point.place.z - 0.5 + slope * slackTexels;
    vec4 moments = momentsAround(first, point);
    // The mean of what is convex is above what the mean makes of it: for a plane by this much.
    float across = 0.5 * slope * kernelRadius(first, point);
    float up = exp(40.0 * (here + 20.0 * across * across)), down = -exp(-40.0 * here);
    // What a texel's slope and rounding make of the warped depths.
    vec2 least = 40.0 * (slope + 1e-4) * vec2(up, down);
    least *= least;
    float lit = min(litAtMost(moments.xy, up, least.x), litAtMost(moments.zw, down, least.y));
    return moments.x == unknown ? 1.0 : lit;
}
)glsl",
            .shared = momentsGlsl(),
            .pyramid = &moments,
            .leastTexels = 8.0F,
            .bleeds = true};
}

}  // namespace gnomon::shadow
