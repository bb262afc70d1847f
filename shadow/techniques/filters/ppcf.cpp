// Shadows of a light with an extent. What lies between a place and the light is looked for as far
// around as the extent can make it matter; how far away it is in the mean gives the width of the
// penumbra, which is the kernel that is compared.
// Randima Fernando. Percentage-Closer Soft Shadows. 2005.
// Where we depart from it: everything is measured across the light's rays, in metres or tangents,
// so that warped maps and cascades have the penumbra they should have; only what is within the cone
// from the place to the light counts as a blocker; comparisons are with the receiver's plane; and
// where what blocks is at heights that differ widely, a wall above a relief, each has a kernel of
// its own.
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
    float quality = shadowMaps[first].kernel.w;
    float searches = max(ceil(perOctave * quality * octaves), leastSearches);
    float step_ = exp2(-octaves / searches);
    float away = reach * sqrt(step_);
    float sum = 0.0, hides = 0.0, lowest = reach, highest = 0.0;
    vec2 turn = vec2(1.0, 0.0);
    float more = quality > 1.0 ? 48.0 : 4.0;
    float count = searching ? searches + more : 0.0;
    for (float i = 0.0; i < count; i += 1.0) {
        ShadowPoint at = movedPoint(first, point, turn * away);
        vec2 between;
        vec4 casters = texelsAt(first, at, between);
        vec4 depths = casters * at.w;
        vec4 cone = spread * (depths - here);
        vec4 hidden = away / max(cone, away);
        vec4 above = vec4(greaterThan(casters, max(planeAt(at, between), 0.0)));
        above *= vec4(greaterThan(cone, vec4(away - texel)));
        hidden *= hidden * above;
        vec4 low = mix(vec4(reach), cone, above), high = above * cone;
        lowest = min(lowest, min(min(low.x, low.y), min(low.z, low.w)));
        highest = max(highest, max(max(high.x, high.y), max(high.z, high.w)));
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
    // A kernel for casters that are at most three times as high as each other, from the highest down:
    // each has the same points of the light, where their rays pass it, and a point is hidden that any
    // of them hides. In the lowest, what is less than half as high as the ray is left out: it hides
    // the light from where it is near, if at all.
    lowest = max(lowest, 0.5 * texel);
    highest = max(highest, lowest);
    float kernels = clamp(ceil(log2(highest / lowest) / log2(3.0)), 1.0, 4.0);
    bool several = kernels > 1.0;
    float ratio = several ? exp2(log2(highest / lowest) / kernels) : 1.0;
    float within = sqrt(ratio);
    float widest = several ? highest / within : radius;
    // As many lookups in all.
    count = several ? min(count, max(ceil(count / kernels), 8.0)) : count;
    float share = count > 1.0 ? inversesqrt(count) : 0.0;
    float perSpread = 1.0 / max(spread, 1e-9);
    float lit = 0.0, open = 1.0, kernel = 0.0, wide = widest, i = 0.5;
    turn = vec2(1.0, 0.0);
    do {
        away = sqrt(i) * share * wide;
        bool last = kernel + 1.0 >= kernels;
        float least = last ? 0.5 * away - 0.5 * texel : wide / within;
        float most = kernel > 0.0 ? wide * within : 1e9;
        ShadowPoint at = movedPoint(first, point, turn * away);
        open = min(open, pageCompareWithin(first, at, here + least * perSpread,
                                           here + most * perSpread));
        lit += last ? open : 0.0;
        open = last ? 1.0 : open;
        kernel = last ? 0.0 : kernel + 1.0;
        wide = last ? widest : wide / ratio;
        turn = last ? goldenTurn * turn : turn;
        i += last ? 1.0 : 0.0;
    } while (i < count);
    lit /= i - 0.5;
    return known >= 0.0 ? known : lit;
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
