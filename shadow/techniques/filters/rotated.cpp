// The disk of pcf, turned by another angle in each texel: steps become noise, which an eye minds
// less, and a fourth of the samples will do. The angle belongs to the place in the light's map, so
// that tiles, eyes and frames have the same noise.
// John Isidoro. Shadow Mapping: GPU-based Tips and Techniques. GDC 2006. The noise, which is even
// within any few neighbours: Jorge Jimenez. Next Generation Post Processing in Call of Duty:
// Advanced Warfare. SIGGRAPH 2014.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_rotated() {
    return {.name = "rotated",
            .source = "Isidoro 2006",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    float radius = kernelReach(first, point);
    float texels = radius * texelsPerUnit(first, point);
    Around all = around(first, point, texels);
    float quality = shadowMaps[first].kernel.w;
    float count = all.lit || all.shadowed ? 0.0 : clamp(ceil(0.5 * texels), 4.0, 16.0) * quality;
    float noise = fract(52.9829189 * fract(dot(floor(point.place.xy), vec2(0.06711056, 0.00583715))));
    vec2 turn = vec2(cos(6.2831853 * noise), sin(6.2831853 * noise));
    float lit = diskShadow(first, point, radius, turn, texels < 0.5 ? min(count, 1.0) : count);
    return all.lit ? 1.0 : all.shadowed ? 0.0 : lit;
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
