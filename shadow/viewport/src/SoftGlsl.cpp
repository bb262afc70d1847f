#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

const PyramidInfo& depthBounds() noexcept {
    // A cell's depths lie between two planes of the same slope: x, y: depth a texel to the right
    // and up, z, w: the lower and the upper plane's depth in the middle of the cell. What is flat,
    // at whatever slope, has its planes close together, so that it is told from what stands on it.
    static constexpr PyramidInfo info{.cell = Cell::rgba32f, .texelsPerCell = 4, .glsl = R"glsl(
vec4 firstLevel(ivec2 cell) {
    vec2 corner = vec2(cell * 4) + 2.0;
    vec4 a = textureGather(page, vec3(corner * texel, layer));
    vec4 b = textureGather(page, vec3((corner + vec2(2.0, 0.0)) * texel, layer));
    vec4 c = textureGather(page, vec3((corner + vec2(0.0, 2.0)) * texel, layer));
    vec4 d = textureGather(page, vec3((corner + vec2(2.0, 2.0)) * texel, layer));
    // Gathered: x (0, 1), y (1, 1), z (1, 0), w (0, 0).
    vec4 low = min(min(a, b), min(c, d)), high = max(max(a, b), max(c, d));
    vec2 flat_ = vec2(min(min(low.x, low.y), min(low.z, low.w)),
                      max(max(high.x, high.y), max(high.z, high.w)));
    vec2 slope = vec2(dot(b + d - a - c, vec4(1.0)), dot(c + d - a - b, vec4(1.0))) / 16.0;
    const vec4 x = vec4(-1.5, -0.5, -0.5, -1.5), y = vec4(-0.5, -0.5, -1.5, -1.5);
    a -= x * slope.x + y * slope.y;
    b -= (x + 2.0) * slope.x + y * slope.y;
    c -= x * slope.x + (y + 2.0) * slope.y;
    d -= (x + 2.0) * slope.x + (y + 2.0) * slope.y;
    low = min(min(a, b), min(c, d));
    high = max(max(a, b), max(c, d));
    vec2 steep = vec2(min(min(low.x, low.y), min(low.z, low.w)),
                      max(max(high.x, high.y), max(high.z, high.w)));
    // Across an edge no slope is of use.
    if (steep.y - steep.x > 0.5 * (flat_.y - flat_.x)) return vec4(0.0, 0.0, flat_);
    return vec4(slope, steep);
}

vec4 nextLevel(ivec2 cell) {
    float half_ = 2.0 * exp2(float(level - 1)); // of the smaller cells, texels
    vec4 parts[4];
    vec2 rise = vec2(0.0);
    vec2 flat_ = vec2(1e30, -1e30);
    for (int i = 0; i < 4; ++i) {
        vec2 side = vec2(i & 1, i >> 1) * 2.0 - 1.0;
        vec4 part = texelFetch(cells, cell * 2 + ivec2(i & 1, i >> 1), 0);
        float around = (abs(part.x) + abs(part.y)) * half_;
        flat_ = vec2(min(flat_.x, part.z - around), max(flat_.y, part.w + around));
        rise += side * (part.z + part.w);
        parts[i] = part;
    }
    vec2 slope = rise / (8.0 * half_);
    vec2 steep = vec2(1e30, -1e30);
    for (int i = 0; i < 4; ++i) {
        vec2 side = vec2(i & 1, i >> 1) * 2.0 - 1.0;
        vec2 off = abs(parts[i].xy - slope) * half_;
        float at = dot(slope, side) * half_;
        steep = vec2(min(steep.x, parts[i].z - at - off.x - off.y),
                     max(steep.y, parts[i].w - at + off.x + off.y));
    }
    if (steep.y - steep.x > 0.5 * (flat_.y - flat_.x)) return vec4(0.0, 0.0, flat_);
    return vec4(slope, steep);
}

// Of the cell and all its neighbours.
vec4 kept(ivec2 cell) {
    float cellSide = 4.0 * exp2(float(level));
    vec4 own = texelFetch(cells, cell, 0);
    ivec2 low = max(cell - 1, ivec2(0)), high = min(cell + 1, ivec2(side - 1));
    vec2 range = own.zw;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            vec4 part = texelFetch(cells, ivec2(x, y), 0);
            vec2 off = abs(part.xy - own.xy) * 0.5 * cellSide;
            float at = dot(own.xy, vec2(x - cell.x, y - cell.y)) * cellSide;
            range = vec2(min(range.x, part.z - at - off.x - off.y),
                         max(range.y, part.w - at + off.x + off.y));
        }
    return vec4(own.xy, range);
}
)glsl"};
    return info;
}

std::string_view softGlsl() noexcept {
    return R"glsl(
layout(binding = 9) uniform sampler2DArray shadowBounds;

// What the texels within a square around a place may be. Everything is as far as float can tell: a
// lookup that it spares would have had the same answer.
struct Around {
    bool lit;       // nothing is nearer to the light than the receiver's plane
    bool shadowed;  // everything is
    float nearest;  // depth that nothing exceeds
};

//   radius  texels
Around around(int first, ShadowPoint point, float radius) {
    radius += 1.0;  // what is interpolated
    // Cells as large as that: their neighbours are in what is known of them. The least power of two,
    // by its exponent.
    int power = (floatBitsToInt(clamp(radius, 4.0, 4e6)) + 0x7fffff) >> 23;
    int level = power - 129;
    float cellSide = intBitsToFloat(power << 23), perCell = intBitsToFloat((254 - power) << 23);
    float pageSize = shadowMaps[first].size.y;
    if (cellSide > pageSize) return Around(false, false, 1.0);
    vec2 corner;
    uint layer = pageOf(first, point, corner);
    vec2 at = point.place.xy - corner;
#ifdef PAGED_MAPS
    vec2 over = abs(at - 0.5 * pageSize) + radius;
    if (layer == pageMissing || max(over.x, over.y) > 0.5 * pageSize)
        return Around(false, false, 1.0);
#endif
    ivec2 cell = ivec2(clamp(at * perCell, vec2(0.0), vec2(ceil(pageSize * perCell) - 1.0)));
    vec4 bounds = texelFetch(shadowBounds, ivec3(cell, int(layer)), level);
    float here = dot(bounds.xy, at - (vec2(cell) + 0.5) * cellSide);
    vec2 off = abs(bounds.xy - point.slope) * radius;
    vec2 own = abs(bounds.xy) * radius;
    float slack = (abs(point.slope.x) + abs(point.slope.y)) * slackTexels + slackDepth;
    // Beyond the map, and beyond its farthest depth where nothing was drawn, it is lit.
    vec2 out_ = abs(point.place.xy - 0.5 * shadowMaps[first].size.x) + radius;
    bool within = max(out_.x, out_.y) <= 0.5 * shadowMaps[first].size.x;
    return Around(bounds.w + here - point.place.z + off.x + off.y <= slack,
                  within && bounds.z + here - own.x - own.y > 0.0 &&
                      bounds.z + here - point.place.z - off.x - off.y > slack,
                  min(bounds.w + here + own.x + own.y, 1.0));
}

// Points of a disk, evenly: the next one is turned by the golden angle. Always the same ones: a
// tile, an eye and the next frame see the same edge. Source: Helmut Vogel. A Better Way to
// Construct the Sunflower Head. 1979.
const mat2 goldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// How many samples of a disk: one a texel across it, so that their steps, each interpolated over a
// texel, follow each other without a gap; with more quality so many that none is seen. One where
// there is no disk.
float samplesOf(int first, float texelsAcross) {
    float quality = shadowMaps[first].kernel.w;
    return texelsAcross < 1.0
               ? 1.0
               : floor(clamp(texelsAcross * quality + 4.0, 5.0, 64.0 * quality));
}

// The share of a disk that is lit. Without samples as with one: software GL executes what is written
// for all pixels, whatever they branch to, so that each lookup is written once and skipped by its
// loop's end alone.
//   radius  in units of the light's plane
//   turn    cosine and sine of the angle that the disk is turned by
float diskShadow(int first, ShadowPoint point, float radius, vec2 turn, float count) {
    float share = count > 1.0 ? radius * inversesqrt(count) : 0.0;
    float lit = 0.0;
    float i = 0.5;
    do {
        lit += pageCompare(first, movedPoint(first, point, turn * (sqrt(i) * share)));
        turn = goldenTurn * turn;
        i += 1.0;
    } while (i < count);
    return lit / (i - 0.5);
}
)glsl";
}

}  // namespace gnomon::shadow
