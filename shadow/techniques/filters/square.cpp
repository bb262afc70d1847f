// The thesis' kernel: a square of texels, all of it or so many samples a row, evenly. Edges are as
// soft as texels are large. Nico Hempe. Diploma thesis on the OpenSG ShadowViewport. 2005,
// chapter 7.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_square() {
    return {.name = "square",
            .source = "Hempe 2005",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    float width = shadowMaps[first].kernel.x, row = shadowMaps[first].kernel.y;
    Around all = around(first, point, 0.5 * width);
    float count = all.lit || all.shadowed ? 0.0 : row * row;
    float between = width / row;
    float lit = 0.0;
    float i = 0.0;
    do {
        vec2 by = (vec2(mod(i, row), floor(i / row)) + 0.5) * between - 0.5 * width;
        ShadowPoint at = point;
        at.place += vec3(by, dot(point.slope, by));
        lit += pageCompare(first, at);
        i += 1.0;
    } while (i < count);
    return all.lit ? 1.0 : all.shadowed ? 0.0 : lit / i;
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
