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
    // As many samples to each octave of distance: what is near a place on its way to the light is near
    // it in the map. Each stands for the share of the light that what it finds there hides.
    float sum = 0.0, count = 0.0;
    float texel = 1.0 / texels;
    float step_ = exp2(-log2(max(2.0 * reach * texels, 2.0)) / float(searches));
    float away = reach * sqrt(step_);
    vec2 turn = vec2(1.0, 0.0);
    for (int i = 0; i < searches; ++i) {
        ShadowPoint at = movedPoint(first, point, turn * away);
        vec2 between;
        vec4 casters = texelsAt(first, at, between);
        vec4 depths = casters * at.w;
        vec4 cone = spread * (depths - here);
        vec4 blocks = vec4(greaterThan(casters, planeAt(at, between))) *
                      vec4(greaterThan(cone, vec4(away - texel)));
        vec4 hidden = away / max(cone, away);
        hidden *= hidden * blocks;
        sum += dot(hidden, depths);
        count += dot(hidden, vec4(1.0));
        turn = goldenTurn * turn;
        away *= step_;
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
