// An edge-aware Gaussian over images of shadow factors. As wide on each surface as in the world:
// across the light's rays, whatever the angle it is seen at. A horizontal and a vertical pass are
// as wide as the kernel's shorter axis; a third one, diagonal, goes along its longer axis by what
// that is longer, so that the three make the whole ellipse. Nico Hempe. Diploma thesis on the
// OpenSG ShadowViewport. 2005, chapter 7.3. Where we depart from it: there a pixel near an edge is
// not blurred at all, or takes what is beyond, and glows. Here each sample counts by how nearly it
// lies on the pixel's own surface. Carlo Tomasi, Roberto Manduchi. Bilateral Filtering for Gray and
// Color Images. 1998.
#include "Glsl.h"

namespace gnomon::render::glsl {

std::string_view blurCommon() noexcept {
    return R"glsl(
// Deviations of a kernel, pixels, of all three passes together: so wide that no pixel needs more than
// the margin. And how many of its deviations a kernel goes.
const float widest = 24.0, goesFor = 2.5;

// A pixel of a surface, as all passes read it. x: bits of its depth. y: the normal in eye space, 10 bits
// each way, as on an equal-area map of the sphere whose middle faces the eye: angles are distances on
// it, but for a third. And 12 bits of the factor, from 1; 0 where the light does not shine, which no
// kernel takes in.
const float steps = 4094.0;
vec2 placeOf(uint bits) { return vec2(bits & 0x3ffu, bits >> 10 & 0x3ffu); }
float codeOf(uint bits) { return float(bits >> 20); }

// Kernels are shares of the widest deviation: x: each way, yz: along the longer axis besides, from one
// half. w, 8 bits each: both together, and 16 times the binary logarithm of the kernel's radius in
// texels, which are as many samples as an edge in a map is worth.
vec2 deviationsOf(vec4 kernel, vec4 pass) {
    return widest * (kernel.x * pass.xy + (kernel.yz * 2.0 - 1.0) * pass.z);
}
float packedReach(float reach, float texels) {
    return (ceil(reach * 255.0) * 256.0 + floor(16.0 * log2(clamp(texels, 1.0, 6e4)) + 0.5)) /
           65535.0;
}
float texelsOf(float packed_) {
    return exp2(float(uint(packed_ * 65535.0 + 0.5) & 0xffu) * 0.0625);
}
// How far all passes go at the most, pixels; a nearer neighbour's kernel may be a little wider.
float reachOf(float packed_) {
    float reach = float(uint(packed_ * 65535.0 + 0.5) >> 8) / 255.0;
    return 1.25 * goesFor * widest * reach + 1.0;
}
)glsl";
}

std::string_view meshUnblurred() noexcept {
    return R"glsl(
layout(location = 4) uniform mat3 eyeFromOrigin;
layout(location = 0) out uvec2 outSurface[LIGHT_COUNT];
layout(location = LIGHT_COUNT) out vec4 outKernel[LIGHT_COUNT];
layout(location = 2 * LIGHT_COUNT) out float outFactor[LIGHT_COUNT];

uint normalBits(vec3 normal) {
    vec2 place = normal.xy * inversesqrt(2.0 + 2.0 * max(normal.z, -0.9999));
    uvec2 bits = uvec2(place * 511.0 + 511.5);
    return bits.x | bits.y << 10;
}

// @param right, up  steps of a pixel on the surface
vec4 kernelAt(int first, ShadowPoint point, vec3 right, vec3 up) {
    mat4 m = shadowMaps[first].mapFromOrigin;
    vec3 u = shadowMaps[first].alongU.xyz, v = shadowMaps[first].alongV.xyz;
    vec4 x = m * vec4(right, 0.0), y = m * vec4(up, 0.0);
    vec2 place = point.place.xy;
    // Texels a pixel, and a deviation's: half the radius of a disk of the same spread.
    vec2 texelsX = x.xy, texelsY = y.xy, a = u.xy, b = v.xy;
    float deviation = 0.5 * kernelReach(first, point);
#ifdef PERSPECTIVE_MAPS
    float perW = 1.0 / max(point.w * point.axial, 1e-6);
    texelsX = (x.xy - place * x.w) * perW;
    texelsY = (y.xy - place * y.w) * perW;
    a -= place * u.z;
    b -= place * v.z;
    deviation /= max(point.w, 1e-6);
#endif
    float area = texelsX.x * texelsY.y - texelsX.y * texelsY.x;
    // Seen edge-on by the light, which has no room for a kernel.
    float scale = abs(area) > 1e-30 ? deviation / area : 0.0;
    a = clamp(scale * vec2(texelsY.y * a.x - texelsY.x * a.y, texelsX.x * a.y - texelsX.y * a.x),
              -1e4, 1e4);
    b = clamp(scale * vec2(texelsY.y * b.x - texelsY.x * b.y, texelsX.x * b.y - texelsX.y * b.x),
              -1e4, 1e4);
    // Covariance, and of its two eigenvalues the smaller one.
    float xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    float half_ = 0.5 * (xx - yy);
    float greater = 0.5 * (xx + yy) + sqrt(half_ * half_ + xy * xy);
    float cross_ = a.x * b.y - a.y * b.x;
    float less = cross_ * cross_ / max(greater, 1e-30);
    float each = min(sqrt(less), widest);
    vec2 more = sqrt(max(vec2(xx, yy) - less, 0.0));
    more.y = xy < 0.0 ? -more.y : more.y;
    float length_ = length(more);
    more *= min(1.0, (widest - each) / max(length_, 1e-6));
    float both = (each + min(length_, widest - each)) / widest;
    return vec4(each / widest, more * (0.5 / widest) + 0.5, packedReach(both, kernelTexels));
}

void unblurred(int i, ShadowPoint point, vec3 face, vec3 right, vec3 up, uint normal,
               out uvec2 surface, out vec4 kernel, out float factor) {
    vec3 toLight;
    lightReaching(i, vPosition, toLight);
    bool shines = dot(face, toLight) > 0.0 && shinesAt(i, vPosition);
    factor = 1.0;
    kernel = vec4(0.0, 0.5, 0.5, 0.0);
    kernelTexels = 0.0;
    if (shines && lights[i].ambient.w > 0.0) {
        factor = shadowFactor(i * MAPS_PER_LIGHT, point);
        kernel = kernelAt(i * MAPS_PER_LIGHT, point, right, up);
    }
    uint code = shines ? uint(factor * steps + 1.5) : 0u;
    surface = uvec2(floatBitsToUint(gl_FragCoord.z), normal | code << 20);
}

void main() {
    surfaceColor();
    vec3 toEye = eye.xyz - vPosition;
    vec3 right = dFdx(vPosition), up = dFdy(vPosition);
    vec3 face = cross(right, up);
    face = dot(face, toEye) < 0.0 ? -face : face;
    uint normal = normalBits(eyeFromOrigin * unit(face));
#define UNBLURRED(i, point)                                                                    \
    unblurred(i, point(i), face, right, up, normal, outSurface[(i) - FIRST_LIGHT], \
              outKernel[(i) - FIRST_LIGHT], outFactor[(i) - FIRST_LIGHT]);
    UNBLURRED_LIGHTS
}
)glsl";
}

std::string_view blurRanges() noexcept {
    return R"glsl(
layout(binding = 11) uniform usampler2DArray surfaces;
layout(binding = 12) uniform sampler2DArray kernels;
layout(location = 0) uniform int layer;
layout(location = 0) out vec4 outRange;

void main() {
    vec2 texel = 1.0 / vec2(textureSize(surfaces, 0).xy);
    vec2 corner = (floor(gl_FragCoord.xy) * 16.0 + 1.0) * texel;
    uvec4 low = uvec4(0xffffu), high = uvec4(0u);
    vec4 reach = vec4(0.0);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            vec2 at = corner + vec2(x, y) * 2.0 * texel;
            uvec4 code = textureGather(surfaces, vec3(at, float(layer)), 1) >> 20;
            vec4 wide = textureGather(kernels, vec3(at, float(layer)), 3);
            bvec4 there = greaterThan(code, uvec4(0u));
            low = min(low, code - 1u);  // none wraps around
            high = max(high, code);
            reach = mix(reach, max(reach, wide), there);
        }
    }
    uint least = min(min(low.x, low.y), min(low.z, low.w)) + 1u;
    uint most = max(max(high.x, high.y), max(high.z, high.w));
    // A block without light is like any other.
    outRange = vec4(most == 0u ? 1.0 : float(least) / 65535.0, float(most) / 65535.0,
                    max(max(reach.x, reach.y), max(reach.z, reach.w)), 0.0);
}
)glsl";
}

std::string_view blurBlocks() noexcept {
    // As far as the widest kernel can go, and a block more: all three passes.
    return R"glsl(
layout(binding = 14) uniform sampler2D ranges;
layout(location = 0) out float outAway;

void main() {
    ivec2 block = ivec2(gl_FragCoord.xy), last = textureSize(ranges, 0) - 1;
    vec4 own = texelFetch(ranges, block, 0);
    float nearest = 255.0;
    for (int y = -5; y <= 5; ++y) {
        for (int x = -5; x <= 5; ++x) {
            vec4 other = texelFetch(ranges, clamp(block + ivec2(x, y), ivec2(0), last), 0);
            bool differ = max(own.y, other.y) > min(own.x, other.x) && other.y > 0.0;
            nearest = differ ? min(nearest, float(max(abs(x), abs(y)))) : nearest;
        }
    }
    bool reached = own.z > 0.0 && (nearest - 1.0) * 16.0 < reachOf(own.z);
    outAway = (reached ? nearest : 255.0) / 255.0;
}
)glsl";
}

std::string_view blurVertex() noexcept {
    return R"glsl(
layout(binding = 15) uniform sampler2D blocks;

void main() {
    ivec2 size = textureSize(blocks, 0);
    int index = gl_VertexID / 6, corner = gl_VertexID - index * 6;
    ivec2 block = ivec2(index % size.x, index / size.x);
    vec2 share = vec2(corner == 1 || corner >= 3 && corner < 5 ? 1.0 : 0.0,
                      corner == 2 || corner >= 4 ? 1.0 : 0.0);
    bool drawn = texelFetch(blocks, block, 0).r < 0.99;
    gl_Position = vec4(drawn ? (vec2(block) + share) / vec2(size) * 2.0 - 1.0 : vec2(2.0), 0.0, 1.0);
}
)glsl";
}

std::string_view blur() noexcept {
    return R"glsl(
layout(binding = 11) uniform usampler2DArray surfaces;
layout(binding = 12) uniform sampler2DArray kernels;
layout(binding = 15) uniform sampler2D blocks;
layout(location = 0) uniform int layer;
layout(location = 1) uniform vec4 pass;     // xy: of the same deviation each way; z: of that along
layout(location = 2) uniform ivec2 size;    // pixels
layout(location = 4) uniform mat4 eyeFromClip;
#ifdef LAST
layout(location = 0) out float outFactor;
#else
layout(location = 0) out uvec2 outSurface;
#endif

// Samples each way at the most.
const float mostSamples = 32.0;
// A sample counts in full up to seven tenths of these, and not at all beyond twelve tenths: tangent of
// the angle at which it is above or below the surface's plane, and angle of its own plane to that.
const float offPlane = 0.25, turned = 0.52;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec2 surface = texelFetch(surfaces, ivec3(pixel, layer), 0).xy;
    vec4 kernel = texelFetch(kernels, ivec3(pixel, layer), 0);
    float own = codeOf(surface.y);
    float away = texelFetch(blocks, pixel / 16, 0).r * 255.0;
    vec2 deviation = deviationsOf(kernel, pass);
    float along = max(abs(deviation.x), abs(deviation.y));
    // Where nothing within the kernel differs, there is nothing to blur.
    bool plain = own < 0.5 || along < 0.25 || (away - 1.0) * 16.0 >= reachOf(kernel.w);

    // The surface's plane.
    float depth = uintBitsToFloat(surface.x);
    vec2 perPixel = 2.0 / vec2(size);
    vec4 h = eyeFromClip * vec4((vec2(pixel) + 0.5) * perPixel - 1.0, depth, 1.0);
    vec3 position = h.xyz / h.w;
    vec2 place = placeOf(surface.y);
    vec2 e = (place - 511.0) / 255.5;
    float square = dot(e, e);
    vec3 normal = vec3(e * sqrt(max(1.0 - 0.25 * square, 0.0)), 1.0 - 0.5 * square);
    vec4 plane = vec4(normal, -dot(normal, position));
    vec3 byClip = vec3(dot(plane, eyeFromClip[0]), dot(plane, eyeFromClip[1]),
                       dot(plane, eyeFromClip[2]));
    // Seen edge-on, where there is no plane to stay on.
    plain = plain || !(abs(byClip.z) > 1e-30);
    vec2 slope = -byClip.xy / (plain ? 1.0 : byClip.z) * perPixel;  // depth a pixel

    // As many samples as the map has texels to tell, and pixels.
    float goes = goesFor * along;
    float wanted = clamp(ceil(1.25 * texelsOf(kernel.w)), 1.0, mostSamples);
    float stride = max(floor(goes / wanted), 1.0);
    vec2 step_ = deviation * (stride / max(along, 1e-6));
    // Within the image, the same on both sides.
    vec2 room = min(vec2(pixel), vec2(size - 1 - pixel)) / max(abs(step_), 1e-3);
    float count = plain ? 0.0 : floor(min(goes / stride + 0.5, min(room.x, room.y)));

    vec4 moved = eyeFromClip[0] * (step_.x * perPixel.x) + eyeFromClip[1] * (step_.y * perPixel.y) +
                 eyeFromClip[2] * dot(slope, step_);
    float metres = length(moved.xyz - position * moved.w) / h.w;
    float perOff = abs(byClip.z) / max(offPlane * metres, 1e-30);
    const float perTurn = 1.0 / (255.5 * turned);
    float ratio = exp(-0.5 * stride * stride / max(along * along, 1e-6));
    float square_ = ratio * ratio;
    float weight = 1.0;
    float sum = own, all = 1.0;
#define TAKE(at, expected)                                                                       \
    {                                                                                            \
        uvec2 there = texelFetch(surfaces, ivec3(at, layer), 0).xy;                           \
        float found = codeOf(there.y);                                                           \
        float z = uintBitsToFloat(there.x);                                                      \
        float off = (expected - z) * perOff / (i * (eyeFromClip[2].w * z + eyeFromClip[3].w));   \
        vec2 turn = (placeOf(there.y) - place) * perTurn;                                        \
        float counts = weight * clamp(1.5 - off * off - dot(turn, turn), 0.0, 1.0);              \
        counts = found < 0.5 ? 0.0 : counts;                                                    \
        sum += counts * found;                                                                   \
        all += counts;                                                                           \
    }
    for (float i = 1.0; i <= count; i += 1.0) {
        weight *= ratio;
        ratio *= square_;
        vec2 by = floor(step_ * i + 0.5);
        float rise = dot(slope, by);
        ivec2 far = ivec2(by);
        TAKE(pixel + far, depth + rise)
        TAKE(pixel - far, depth - rise)
    }
    float code = count > 0.0 ? sum / all : own;
#ifdef LAST
    outFactor = (code - 1.0) / steps;
#else
    outSurface = uvec2(surface.x, surface.y & 0xfffffu | uint(code + 0.5) << 20);
#endif
}
)glsl";
}

}  // namespace gnomon::render::glsl
