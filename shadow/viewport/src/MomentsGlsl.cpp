#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

std::string_view momentLevelsGlsl() noexcept {
    return R"glsl(
vec4 nextLevel(ivec2 cell) {
    ivec2 at = cell * 2;
    return 0.25 * (texelFetch(cells, at, 0) + texelFetch(cells, at + ivec2(1, 0), 0) +
                   texelFetch(cells, at + ivec2(0, 1), 0) + texelFetch(cells, at + ivec2(1, 1), 0));
}

// Of a cell and its neighbours: binomial, so that what is interpolated has no corners. The finest
// stays as it is, for kernels that are hardly wider than a texel.
vec4 kept(ivec2 cell) {
    if (level == 0) return texelFetch(cells, cell, 0);
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = cell + ivec2(x, y);
            bool within = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(side)));
            sum += (within ? texelFetch(cells, at, 0) : nothing) *
                   float((2 - abs(x)) * (2 - abs(y)));
        }
    return sum / 16.0;
}
)glsl";
}

std::string_view momentsGlsl() noexcept {
    return R"glsl(
layout(binding = 9) uniform sampler2DArray shadowMoments;

// Of the kernel, texels: as wide as the finest cells are at the least.
float kernelRadius(int first, ShadowPoint point) {
    return max(kernelReach(first, point) * texelsPerUnit(first, point), 2.0);
}

// Where nothing was drawn, and all is lit.
const float unknown = 1e30;

// Moments over the kernel: the level whose cells, with what is blurred and interpolated of them, are
// as wide.
vec4 momentsAround(int first, ShadowPoint point) {
    float radius = kernelRadius(first, point);
    vec2 corner;
    uint layer = pageOf(first, point, corner);
#ifdef PAGED_MAPS
    if (layer == pageMissing) return vec4(unknown);
#endif
    vec2 at = point.place.xy - corner;
    vec2 off = abs(point.place.xy - 0.5 * shadowMaps[first].size.x);
    // Beyond its farthest depth, too: what is drawn there is at depth 0, not where it is.
    if (max(off.x, off.y) > 0.5 * shadowMaps[first].size.x || point.place.z <= 0.0)
        return vec4(unknown);
    float cells = float(textureSize(shadowMoments, 0).x);
    // Radii, in texels: 2 of the finest, then 8 and doubling.
    float octaves = log2(radius * 0.5);
    return textureLod(shadowMoments, vec3(at / (2.0 * cells), float(layer)),
                      octaves < 2.0 ? octaves * 0.5 : octaves - 1.0);
}

// What may be lit at the most. Source: Pafnuty Chebyshev, one-sided. A part of it is taken away,
// where light bleeds through casters at two distances. Source: Andrew Lauritzen. Summed-Area Variance
// Shadow Maps. GPU Gems 3, 2007.
float litAtMost(vec2 moments, float here, float leastVariance) {
    float behind = moments.x - here;
    float variance = max(moments.y - moments.x * moments.x, leastVariance);
    float most = variance / (variance + behind * behind);
    return behind <= 0.0 ? 1.0 : clamp((most - 0.2) / 0.8, 0.0, 1.0);
}
)glsl";
}

}  // namespace gnomon::shadow
