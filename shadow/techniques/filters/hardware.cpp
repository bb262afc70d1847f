// The disk of pcf, each sample compared and interpolated by the texture unit. It compares all four
// texels with one depth, so that the receiver's plane has to be as near to the light as it is at
// the nearest of them: what touches a steep receiver shadows it a texel later.
// William Reeves, David Salesin, Robert Cook. Rendering Antialiased Shadows with Depth Maps. 1987.
// In hardware: Mark Segal et al. Fast Shadows and Lighting Effects Using Texture Mapping. 1992.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_hardware() {
    return {.name = "hardware",
            .source = "Reeves, Salesin, Cook 1987",
            .glsl = R"glsl(
layout(binding = 13) uniform sampler2DArrayShadow shadowComparisons;

float compared(int first, ShadowPoint point, float steps) {
    vec2 corner;
    uint layer = pageOf(first, point, corner);
#ifdef PAGED_MAPS
    if (layer == pageMissing) return 1.0;
#endif
    vec2 at = (point.place.xy - corner + 1.0) * shadowMaps[first].size.z;
    return texture(shadowComparisons, vec4(at, float(layer), max(point.place.z + steps, 0.0)));
}

float filteredShadow(int first, ShadowPoint point) {
    float radius = kernelReach(first, point);
    float texels = radius * texelsPerUnit(first, point);
    Around all = around(first, point, texels);
    float count = all.lit || all.shadowed ? 0.0 : samplesOf(first, 2.0 * texels);
    float steps = (abs(point.slope.x) + abs(point.slope.y)) * (1.0 + slackTexels) + slackDepth;
    float share = count > 1.0 ? radius * inversesqrt(count) : 0.0;
    float lit = 0.0;
    vec2 turn = vec2(1.0, 0.0);
    float i = 0.5;
    do {
        lit += compared(first, movedPoint(first, point, turn * sqrt(i) * share), steps);
        turn = goldenTurn * turn;
        i += 1.0;
    } while (i < count);
    return all.lit ? 1.0 : all.shadowed ? 0.0 : lit / (i - 0.5);
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
