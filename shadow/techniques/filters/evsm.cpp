// Variance shadow maps of depths that an exponential warps, one way and the other: light bleeds
// less, since the warped distance of casters to each other is small beside that to what they
// shadow. Andrew Lauritzen, Michael McCool. Layered Variance Shadow Maps. 2008.
// With twice the exponent squares would still fit into a float, but planes that the light grazes
// would be too steep for their own mean.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {
namespace {

const PyramidInfo evsmMoments{.cell = Cell::rgba32f,
                              .texelsPerCell = 2,
                              .glsl = "const float exponent = 40.0;\n",
                              .levels = exponentLevelsGlsl()};

}  // namespace

FilterInfo describe_evsm() {
    return {.name = "evsm",
            .source = "Lauritzen, McCool 2008",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    return litByExponents(first, point, 40.0, 1e-4);
}
)glsl",
            .shared = momentsGlsl(),
            .pyramid = &evsmMoments,
            .leastTexels = 8.0F,
            .bleeds = true};
}

}  // namespace gnomon::shadow
