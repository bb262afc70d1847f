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
// Searches an octave of distance, and how many there are at the least.
const float perOctave = 1.4, leastSearches = 6.0;

float filteredShadow(int first, ShadowPoint point) {
    float spread = shadowMaps[first].light.x;
    float here = point.place.z * point.w;
    float reach = min(spread * (1.0 - here), shadowMaps[first].kernel.z);
    float texels = texelsPerUnit(first, point);
    float most = length(vec2(shadowMaps[first].alongU.z, shadowMaps[first].alongV.z));
    Around all = around(first, point, reach * texels);
    float known = all.lit ? 1.0 : all.shadowed ? 0.0 : -1.0;
    // What may block is nearer in a smaller neighbourhood, and then matters in a smaller one.
    reach = clamp(spread * (all.nearest * (point.w + reach * most) - here), 0.0, reach);
    // As many samples to each octave of distance: what is near a place on its way to the light is near
    // it in the map. Each stands for the share of the light that what it finds there hides.
    bool searching = known < 0.0 && reach * texels >= 0.5;
    float texel = 1.0 / texels;
    float octaves = log2(max(2.0 * reach * texels, 2.0));
    float searches = max(ceil(perOctave * octaves), leastSearches);
    float step_ = exp2(-octaves / searches);
    float away = reach * sqrt(step_);
    float sum = 0.0, hides = 0.0;
    vec2 turn = vec2(1.0, 0.0);
    float more = shadowMaps[first].kernel.w > 1.0 ? 48.0 : 4.0;
    float count = searching ? searches + more : 0.0;
    for (float i = 0.0; i < count; i += 1.0) {
        ShadowPoint at = movedPoint(first, point, turn * away);
        vec2 between;
        vec4 casters = texelsAt(first, at, between);
        vec4 depths = casters * at.w;
        vec4 cone = spread * (depths - here);
        vec4 hidden = away / max(cone, away);
        vec4 above = vec4(greaterThan(casters, max(planeAt(at, between), 0.0)));
        hidden *= hidden * above * vec4(greaterThan(cone, vec4(away - texel)));
        sum += dot(hidden, depths);
        hides += dot(hidden, vec4(1.0));
        turn = goldenTurn * turn;
        away *= step_;
        // Nothing yet: what hides little of the light is toward the rim.
        if (i >= searches - 1.0) {
            away = reach * mix(0.3, 1.0, (i - searches + 1.5) / more);
            count = hides > 0.0 ? 0.0 : count;
        }
    }
    known = searching && hides == 0.0 ? 1.0 : known;
    float radius = hides > 0.0 ? min(spread * max(sum / hides - here, 0.0), reach) : 0.0;
    count = known >= 0.0 ? 0.0 : samplesOf(first, 2.0 * radius * texels);
    // What is low beside the penumbra's casters hides the light from where it is near, if at all: what
    // is less than half as high as the ray to the light's rim is left out.
    float rise = 0.5 / max(spread, 1e-9);
    float lit =
        diskShadow(first, point, radius, vec2(1.0, 0.0), count, here - texel * rise, rise);
    return known >= 0.0 ? known : lit;
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
