#include <gnomon/shadow/Filter.h>

#include <string>

namespace gnomon::shadow {

namespace {

constexpr std::string_view levels = R"glsl(
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

std::string with(std::string_view firstLevel) { return std::string{firstLevel}.append(levels); }

}  // namespace

std::string_view varianceLevelsGlsl() {
    static const std::string text = with(R"glsl(
// Of a depth of 0.
const vec4 nothing = vec4(stored(-0.5, 0.25), 0.0, 0.0);
vec4 firstLevel(ivec2 cell) {
    vec4 depths = textureGather(page, vec3((vec2(cell * 2) + 2.0) * texel, layer)) - 0.5;
    return vec4(stored(dot(depths, vec4(0.25)), dot(depths, depths) * 0.25), 0.0, 0.0);
}
)glsl");
    return text;
}

std::string_view exponentLevelsGlsl() {
    static const std::string text = with(R"glsl(
const vec4 nothing = vec4(exp(-0.5 * exponent), exp(-exponent), -exp(0.5 * exponent), exp(exponent));
vec4 firstLevel(ivec2 cell) {
    vec4 depths = textureGather(page, vec3((vec2(cell * 2) + 2.0) * texel, layer)) - 0.5;
    vec4 up = exp(exponent * depths), down = -exp(-exponent * depths);
    return 0.25 * vec4(dot(up, vec4(1.0)), dot(up, up), dot(down, vec4(1.0)), dot(down, down));
}
)glsl");
    return text;
}

std::string_view momentsGlsl() noexcept {
    return R"glsl(
layout(binding = 9) uniform sampler2DArray shadowMoments;

// What a kernel, a disk of the light's plane, covers of a map: in warped ones an ellipse.
struct Footprint {
    vec2 axis;    // unit, of the longer half axis
    float major;  // half axes, texels; as wide as the finest cells at the least
    float minor;
    float radius;  // of as many round cells side by side along the axis, texels
    float cells;
    float apart;   // from one to the next, texels
};

Footprint footprintOf(int first, ShadowPoint point) {
    vec2 a, b;
    texelsAlong(first, point, a, b);
    // Axes of a disk's image: the eigenvectors of a a' + b b'.
    float xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    float mean = 0.5 * (xx + yy), half_ = 0.5 * (xx - yy);
    float apart = sqrt(half_ * half_ + xy * xy);
    // The cosine is of twice their angle; of a circle any.
    float cosine = clamp(half_ / max(apart, 1e-20), -1.0, 1.0);
    vec2 axis = sqrt(vec2(0.5) + vec2(0.5, -0.5) * cosine);
    axis.y = xy < 0.0 ? -axis.y : axis.y;
    float reach = kernelReach(first, point);
    float major = max(reach * sqrt(mean + apart), 2.0);
    float minor = max(reach * sqrt(max(mean - apart, 0.0)), 2.0);
    // Five cells at the most, beyond that they are wider; one where that is hardly too wide.
    float radius = max(minor, major / 3.5);
    bool one = major < 1.3 * radius;
    float cells = one ? 1.0 : ceil(1.6 * major / radius - 0.64);
    radius = one ? sqrt(major * radius) : radius;
    // So that they have the disk's variance along the axis.
    float step_ = one ? 0.0 : sqrt(3.0 * (major * major - radius * radius) / (cells * cells - 1.0));
    return Footprint(axis, major, minor, radius, cells, step_);
}

// Where nothing was drawn, and all is lit.
const float unknown = 1e30;

// Moments over a kernel: of the level whose cells, with what is blurred and interpolated of them, are
// as wide, side by side along the longer axis. Source: Joel McCormack et al. Feline: Fast Elliptical
// Lines for Anisotropic Texture Mapping. 1999.
vec4 momentsAround(int first, ShadowPoint point, Footprint kernel) {
    vec2 off = abs(point.place.xy - 0.5 * shadowMaps[first].size.x);
    // Beyond its farthest depth, too: what is drawn there is at depth 0, not where it is.
    bool outside = max(off.x, off.y) > 0.5 * shadowMaps[first].size.x || point.place.z <= 0.0;
    float perCell = 0.5 / float(textureSize(shadowMoments, 0).x);
    // Radii, in texels: 2 of the finest, then 8 and doubling.
    float octaves = log2(kernel.radius * 0.5);
    float level = octaves < 2.0 ? octaves * 0.5 : octaves - 1.0;
    vec2 step_ = kernel.axis * kernel.apart;
    point.place.xy -= 0.5 * (kernel.cells - 1.0) * step_;
    vec4 sum = vec4(0.0);
    float i = 0.0;
    do {
        vec2 corner;
        uint layer = pageOf(first, point, corner);
#ifdef PAGED_MAPS
        outside = outside || layer == pageMissing;
#endif
        sum += textureLod(shadowMoments, vec3((point.place.xy - corner) * perCell, float(layer)), level);
        point.place.xy += step_;
        i += 1.0;
    } while (i < kernel.cells);
    return outside ? vec4(unknown) : sum / i;
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

// By the moments of depths, which count from the middle of their range.
//   steps  variance that their format makes of nothing
float litByVariance(ShadowPoint point, vec2 moments, float steps) {
    float slope = abs(point.slope.x) + abs(point.slope.y);
    float here = point.place.z - 0.5 + slope * slackTexels;
    return litAtMost(moments, here, steps + slope * slope * 0.25);
}

// By the moments of depths that an exponential warps, one way and the other.
//   steps  what their format makes of nothing, as a deviation of the depth
float litByExponents(int first, ShadowPoint point, float exponent, float steps) {
    float slope = abs(point.slope.x) + abs(point.slope.y);
    float here = point.place.z - 0.5 + slope * slackTexels;
    Footprint kernel = footprintOf(first, point);
    vec4 moments = momentsAround(first, point, kernel);
    // The mean of what is convex is above what the mean makes of it: for a plane by this much.
    float along = dot(point.slope, kernel.axis) * kernel.major;
    float across = dot(point.slope, vec2(-kernel.axis.y, kernel.axis.x)) * kernel.minor;
    float square = 0.25 * (along * along + across * across);
    float up = exp(exponent * (here + 0.5 * exponent * square));
    float down = -exp(-exponent * here);
    // What a texel's slope and rounding make of the warped depths.
    vec2 least = exponent * (slope + steps) * vec2(up, down);
    least *= least;
    float lit = min(litAtMost(moments.xy, up, least.x), litAtMost(moments.zw, down, least.y));
    return moments.x == unknown ? 1.0 : lit;
}
)glsl";
}

}  // namespace gnomon::shadow
