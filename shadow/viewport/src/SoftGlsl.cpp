#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

const PyramidInfo& depthBounds() noexcept {
    // A cell's depths lie between two planes of the same slope: x, y: depth a texel to the right
    // and up, z, w: the lower and the upper plane's depth in the middle of the cell. What is flat,
    // at whatever slope, has its planes close together, so that it is told from what stands on it.
    static constexpr PyramidInfo info{.channels = 4, .texelsPerCell = 4, .glsl = R"glsl(
vec4 firstLevel(ivec2 cell) {
    vec2 corner = vec2(cell * 4) + 2.0;
    vec4 a = textureGather(source, vec3(corner * texel, layer));
    vec4 b = textureGather(source, vec3((corner + vec2(2.0, 0.0)) * texel, layer));
    vec4 c = textureGather(source, vec3((corner + vec2(0.0, 2.0)) * texel, layer));
    vec4 d = textureGather(source, vec3((corner + vec2(2.0, 2.0)) * texel, layer));
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
    vec2 low = vec2(1e30), high = vec2(-1e30), mean = vec2(0.0), rise = vec2(0.0);
    vec2 flat_ = vec2(1e30, -1e30);
    for (int i = 0; i < 4; ++i) {
        vec2 side = vec2(i & 1, i >> 1) * 2.0 - 1.0;
        vec4 part = texelFetch(source, ivec3(cell * 2 + ivec2(i & 1, i >> 1), layer), 0);
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
)glsl"};
    return info;
}

std::string_view softGlsl() noexcept {
    return R"glsl(
layout(binding = 9) uniform sampler2DArray shadowBounds;

// A cell of the bounds, by its place among those of the whole map.
vec4 boundsOf(int first, ShadowPoint point, ivec2 cell, int level) {
#ifdef PAGED_MAPS
    int inPage = int(shadowMaps[first].size.y) >> (level + 2);
    int side = int(shadowMaps[first].pages.x);
    ivec2 page = clamp(cell / inPage, ivec2(0), ivec2(side - 1));
    uint entry = point.pages + uint(page.y * side + page.x);
    uint layer = pageTable[entry >> 2u][entry & 3u];
    if (layer == pageMissing) return vec4(0.0);
    cell = clamp(cell - page * inPage, ivec2(0), ivec2(inPage - 1));
#else
    uint layer = point.pages;
#endif
    return texelFetch(shadowBounds, ivec3(cell, int(layer)), level);
}

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
    int level = int(ceil(log2(max(radius * 0.5, 1.0))));
    int pageSide = int(shadowMaps[first].size.y);
    if ((4 << level) > pageSide) return Around(false, false, 1.0);
    float cellSide = float(4 << level);
    ivec2 last = ivec2(ceil(shadowMaps[first].size.x / cellSide)) - 1;
    ivec2 low = clamp(ivec2(floor((point.place.xy - radius) / cellSide)), ivec2(0), last);
    ivec2 high = clamp(ivec2(floor((point.place.xy + radius) / cellSide)), ivec2(0), last);
    float above = -1e30, below = 1e30, nearest = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 cell = ivec2((i & 1) == 0 ? low.x : high.x, (i >> 1) == 0 ? low.y : high.y);
        vec4 bounds = boundsOf(first, point, cell, level);
        // Depths count from the middle of texel (0, 0) of the cell; a place from its corner.
        float at = dot(bounds.xy, point.place.xy - (vec2(cell) + 0.5) * cellSide);
        vec2 off = abs(bounds.xy - point.slope) * radius;
        above = max(above, bounds.w + at - point.place.z + off.x + off.y);
        below = min(below, bounds.z + at - point.place.z - off.x - off.y);
        vec2 own = abs(bounds.xy) * radius;
        nearest = max(nearest, bounds.w + at + own.x + own.y);
    }
    float slack = (abs(point.slope.x) + abs(point.slope.y)) * slackTexels + slackDepth;
    // Beyond the map it is lit.
    vec2 off = abs(point.place.xy - 0.5 * shadowMaps[first].size.x) + radius;
    bool within = max(off.x, off.y) <= 0.5 * shadowMaps[first].size.x;
    return Around(above <= slack, within && below > slack, min(nearest, 1.0));
}

// Points of a disk, evenly: the next one is turned by the golden angle. Always the same ones: a
// tile, an eye and the next frame see the same edge. Source: Helmut Vogel. A Better Way to
// Construct the Sunflower Head. 1979.
const mat2 goldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// The share of a disk that is lit. A sample is interpolated over a texel; there are as many as texels
// across the disk, so that their steps follow each other without a gap.
//   radius  in units of the light's plane
float diskShadow(int first, ShadowPoint point, float radius) {
    float across = 2.0 * radius * texelsPerUnit(first, point);
    if (across < 1.0) return pageCompare(first, point);
    int count = int(clamp(across + 8.0, 8.0, 64.0));
    float share = radius * inversesqrt(float(count));
    float lit = 0.0;
    vec2 turn = vec2(1.0, 0.0);
    for (int i = 0; i < count; ++i) {
        lit += pageCompare(first, movedPoint(first, point, turn * (sqrt(float(i) + 0.5) * share)));
        turn = goldenTurn * turn;
    }
    return lit / float(count);
}
)glsl";
}

}  // namespace gnomon::shadow
