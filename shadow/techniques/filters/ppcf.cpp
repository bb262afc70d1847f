// Shadows of a light with an extent. What lies between a place and the light is looked for as far
// around as the extent can make it matter; how far away it is in the mean gives the width of the
// penumbra, which is the kernel that is compared.
// Randima Fernando. Percentage-Closer Soft Shadows. 2005.
// Where we depart from it: everything is measured across the light's rays, in metres or tangents,
// so that warped maps and cascades have the penumbra they should have; only what is within the cone
// from the place to the light counts as a blocker; and comparisons are with the receiver's plane.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_ppcf() {
    return {.name = "ppcf",
            .source = "Fernando 2005",
            .glsl = R"glsl(
const int searches = 16;

float filteredShadow(int first, ShadowPoint point) {
    float spread = shadowMaps[first].light.x;
    float most = length(vec2(shadowMaps[first].alongU.z, shadowMaps[first].alongV.z));
    float here = point.place.z * point.w;
    float reach = min(spread * (1.0 - here), shadowMaps[first].kernel.z);
    float texels = texelsPerUnit(first, point);
    // What may block is nearer in a smaller neighbourhood, and then matters in a smaller one.
    for (int i = 0; i < 4; ++i) {
        Around all = around(first, point, reach * texels);
        if (all.lit || all.shadowed) return all.lit ? 1.0 : 0.0;
        float w = point.w + reach * most;
        float enough = max(spread * (all.nearest * w - here), 0.0);
        if (enough > reach * 0.8) break;
        reach = enough;
    }
    if (reach * texels < 0.5) return pageCompare(first, point);
    float sum = 0.0, count = 0.0, looked = 0.0;
    vec2 turn = vec2(1.0, 0.0);
    float share = inversesqrt(float(searches));
    for (int i = 0; i < searches; ++i) {
        vec2 by = turn * (sqrt(float(i) + 0.5) * share * reach);
        turn = goldenTurn * turn;
        ShadowPoint at = movedPoint(first, point, by);
        vec2 between;
        vec4 casters = texelsAt(first, at, between);
        vec4 depths = casters * at.w;
        // Of the cone around the light, where the tap is; a texel more, for its size.
        float cone = max(length(by) - 1.0 / texels, 0.0);
        vec4 blocks = vec4(greaterThan(casters, planeAt(at, between))) *
                      vec4(greaterThanEqual(spread * (depths - here), vec4(cone)));
        sum += dot(blocks, depths);
        count += dot(blocks, vec4(1.0));
    }
    if (count == 0.0) return 1.0;
    float radius = min(spread * max(sum / count - here, 0.0), reach);
    return diskShadow(first, point, radius);
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
