// vsm with moments of 16 bits, in half the memory. Shares of 1 in even steps tell casters from
// receivers that are some 0.5 % of the map's depth apart; half floats would need 1.6 %.
// William Donnelly, Andrew Lauritzen. Variance Shadow Maps. 2006.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {
namespace {

const PyramidInfo vsm16Moments{
    .cell = Cell::rg16,
    .texelsPerCell = 2,
    .glsl = "#define stored(mean, square) vec2((mean) + 0.5, 4.0 * (square))\n",
    .levels = varianceLevelsGlsl()};

}  // namespace

FilterInfo describe_vsm16() {
    return {.name = "vsm16",
            .source = "Donnelly, Lauritzen 2006",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    vec4 moments = momentsAround(first, point, footprintOf(first, point));
    // Half a step of either: of the mean, which is squared, and of a fourth of the square.
    float lit = litByVariance(point, vec2(moments.x - 0.5, 0.25 * moments.y), 1.5 / 65535.0);
    return moments.x == unknown ? 1.0 : lit;
}
)glsl",
            .shared = momentsGlsl(),
            .pyramid = &vsm16Moments,
            .leastTexels = 8.0F,
            .bleeds = true};
}

}  // namespace gnomon::shadow
