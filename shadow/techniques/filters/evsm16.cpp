// evsm with half floats, in half the memory: exp(11) is the largest square that fits, where depths
// count from the middle of their range; from its near side it would be exp(5.54).
// Andrew Lauritzen, Michael McCool. Layered Variance Shadow Maps. 2008.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {
namespace {

const PyramidInfo evsm16Moments{.cell = Cell::rgba16f,
                                .texelsPerCell = 2,
                                .glsl = "const float exponent = 11.0;\n",
                                .levels = exponentLevelsGlsl()};

}  // namespace

FilterInfo describe_evsm16() {
    return {.name = "evsm16",
            .source = "Lauritzen, McCool 2008",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    return litByExponents(first, point, 11.0, 3e-3);
}
)glsl",
            .shared = momentsGlsl(),
            .pyramid = &evsm16Moments,
            .leastTexels = 8.0F,
            .bleeds = true};
}

}  // namespace gnomon::shadow
