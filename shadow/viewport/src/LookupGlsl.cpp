#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

std::string_view mapsGlsl() noexcept {
    return R"glsl(
struct ShadowMap {
    mat4 mapFromOrigin;  // x and y in texels, z reversed depth, all times w
    vec4 fromFirst;      // texels of this map from those of the light's first: scale, offset
    vec4 size;           // texels a side x: of the map, y: of a page; z: 1 / (page with its border),
                         // w: 1 / map
    uvec4 pages;         // x: pages a side, y: first entry of the table, z: the layer where x is 1
    vec4 alongU;         // what a step across the rays does to x, y and w; and so does alongV.
    vec4 alongV;         // alongU.w, alongV.w: how far lookups go around a place in x and y, shares
                         // of the map's sides
    vec4 light;          // x: radius of its penumbra, in units of the light's plane, by depth times w;
                         // y, z: a place's distance along its axis is y + z * depth * w (parallel: 1)
                         // w: radius of fixed kernels, metres
    vec4 kernel;         // x: width, texels, y: samples a row; z: reach, in units of its plane;
                         // w: quality, times so many samples
};
layout(std140, binding = 4) uniform ShadowMapBlock { ShadowMap shadowMaps[128]; };

// Where a place, relative to the group's origin, is in a light's first map.
vec4 shadowPlace(int first, vec3 position) {
    return shadowMaps[first].mapFromOrigin * vec4(position, 1.0);
}
)glsl";
}

std::string_view lookupGlsl() noexcept {
    // Depth is compared texel by texel with the receiver's own plane, so that a plane does not
    // shadow itself at whatever slope, and nothing is moved toward the light to see to that: a
    // caster may all but touch what it shadows. Source: Hang Dou, Yajie Yan, Ethan Kerzner, Zeng
    // Dai, Chris Wyman. Adaptive Depth Bias for Shadow Maps. 2014. Here the depths are gathered.
    return R"glsl(
layout(std140, binding = 5) uniform PageTableBlock { uvec4 pageTable[1024]; };
layout(binding = 8) uniform sampler2DArray shadowPages;

const uint pageMissing = 0xffffffffu;

// What rounding may do to the plane's depth: a share of what a texel spans (vertices snap to parts of
// a texel when a map is drawn), and of the depth itself.
const float slackTexels = 0.1;
const float slackDepth = 2e-6;

// A receiver in one of a light's maps: place in texels and depth, how much depth a texel spans on
// its plane, to the right and up, and which map that is: its layer, or its first entry in the table.
struct ShadowPoint {
    vec3 place;
    vec2 slope;
    uint pages;
    float w;      // of the place on the light's plane
    float axial;  // distance along the light's axis, metres; 1 where it is parallel
    vec2 scale;   // texels of its map by those of the light's first
};

// The plane through two steps on it.
vec2 slopeOf(vec3 a, vec3 b) {
    float area = a.x * b.y - a.y * b.x;
    // Seen edge-on by the light a plane has no slope; what faces the light hardly ever is.
    float safe = abs(area) > 1e-12 ? area : 1e-12;
    return vec2(a.z * b.y - b.z * a.y, b.z * a.x - a.z * b.x) / safe;
}

vec3 projectedPlace(vec4 place) {
#ifdef PERSPECTIVE_MAPS
    // Behind a spot, or before the vanishing point of a warp, where nothing is shadowed.
    return place.w > 1e-6 ? place.xyz / place.w : vec3(-1e6, -1e6, 1.0);
#else
    return place.xyz;
#endif
}

uint pagesOf(int map) {
#ifdef PAGED_MAPS
    return shadowMaps[map].pages.y;
#else
    return shadowMaps[map].pages.z;
#endif
}

float axialOf(int first, vec4 place) {
#ifdef PERSPECTIVE_MAPS
    return max(shadowMaps[first].light.y + shadowMaps[first].light.z * place.z, 1e-6);
#else
    return 1.0;
#endif
}

// In a light's first map, from an interpolated shadowPlace(). In uniform control flow.
ShadowPoint interpolatedPoint(int first, vec4 place) {
    vec3 q = projectedPlace(place);
    vec2 slope = slopeOf(dFdx(q), dFdy(q));
    float axial = axialOf(first, place);
    return ShadowPoint(q, slope, pagesOf(first), place.w / axial, axial, vec2(1.0));
}

// In a light's first map, from a surface. @param normal  unit, of the surface's plane
ShadowPoint foundPoint(int first, vec3 position, vec3 normal) {
    mat4 m = shadowMaps[first].mapFromOrigin;
    vec4 place = m * vec4(position, 1.0);
    vec3 q = projectedPlace(place);
    // Source: Tom Duff et al. Building an Orthonormal Basis, Revisited. 2017.
    float s = normal.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + normal.z);
    float b = normal.x * normal.y * a;
    vec4 u = m * vec4(1.0 + s * normal.x * normal.x * a, s * b, -s * normal.x, 0.0);
    vec4 v = m * vec4(b, s + normal.y * normal.y * a, -normal.y, 0.0);
    float axial = axialOf(first, place);
    return ShadowPoint(q, slopeOf(u.xyz - q * u.w, v.xyz - q * v.w), pagesOf(first),
                       place.w / axial, axial, vec2(1.0));
}

// The layer of the page that a place is in, and where in the map that page begins; pageMissing where
// it was not drawn.
uint pageOf(int first, ShadowPoint point, out vec2 corner) {
#ifdef PAGED_MAPS
    float pageSize = shadowMaps[first].size.y;
    uint side = shadowMaps[first].pages.x;
    uvec2 page = uvec2(clamp(point.place.xy / pageSize, vec2(0.0), vec2(float(side) - 1.0)));
    uint entry = point.pages + page.y * side + page.x;
    corner = vec2(page) * pageSize;
    return pageTable[entry >> 2u][entry & 3u];
#else
    corner = vec2(0.0);
    return point.pages;
#endif
}

// Radius of a fixed kernel, in units of the light's plane.
float kernelReach(int first, ShadowPoint point) {
    return min(shadowMaps[first].light.w / point.axial, shadowMaps[first].kernel.z);
}

// The four texels nearest to a place, as gathered, and where between them it is. Nothing, as far away
// as can be, beyond the map and where no page was drawn.
//   first  any map of the light: all its maps are of one size
vec4 texelsAt(int first, ShadowPoint point, out vec2 share) {
    vec2 corner = floor(point.place.xy - 0.5);
    share = point.place.xy - 0.5 - corner;
    vec2 pageCorner;
    uint layer = pageOf(first, point, pageCorner);
#ifdef PAGED_MAPS
    if (layer == pageMissing) return vec4(0.0);
#endif
    corner -= pageCorner;
    // Between the four: one texel of border, one to their common corner.
    return textureGather(shadowPages,
                         vec3((corner + 2.0) * shadowMaps[first].size.z, float(layer)));
}

// Depths of a receiver's plane at the four texels, a little nearer to the light.
vec4 planeAt(ShadowPoint point, vec2 share) {
    vec2 slope = point.slope;
    float slack = (abs(slope.x) + abs(slope.y)) * slackTexels + slackDepth;
    float here = point.place.z - dot(slope, share) + slack;
    return vec4(here + slope.y, here + slope.x + slope.y, here + slope.x, here);
}

// Of four texels, as gathered, what is between them.
float interpolated(vec4 texels, vec2 share) {
    vec2 row = mix(texels.wx, texels.zy, share.x);
    return mix(row.x, row.y, share.y);
}

// Comparison at a place in a map, interpolated between the four nearest texels.
// What is not nearer to the light than the place itself cannot shadow it: where surfaces meet, a
// texel away, the other one may be above the receiver's plane. And a receiver beyond the map is never
// darker than what was not drawn.
float pageCompare(int first, ShadowPoint point) {
    vec2 share;
    vec4 casters = texelsAt(first, point, share);
    float least = max(point.place.z, 0.0);
    return interpolated(vec4(greaterThanEqual(max(planeAt(point, share), least), casters)), share);
}

// The same of those casters whose depth times w is within a range.
float pageCompareWithin(int first, ShadowPoint point, float least, float most) {
    vec2 share;
    vec4 casters = texelsAt(first, point, share);
#ifdef PERSPECTIVE_MAPS
    float perW = 1.0 / max(point.w, 1e-6);
    least *= perW;
    most *= perW;
#endif
    least = max(max(least, point.place.z), 0.0);
    vec4 lit = vec4(greaterThanEqual(max(planeAt(point, share), least), casters));
    return interpolated(max(lit, vec4(greaterThan(casters, vec4(most)))), share);
}

// The point of the receiver's plane that is seen elsewhere. @param by  units of the light's plane
ShadowPoint movedPoint(int first, ShadowPoint point, vec2 by) {
    vec3 u = shadowMaps[first].alongU.xyz, v = shadowMaps[first].alongV.xyz;
    vec2 step_ = (u.xy * by.x + v.xy * by.y) * point.scale;
#ifdef PERSPECTIVE_MAPS
    float w = point.w + u.z * by.x + v.z * by.y;
    // At a vanishing point, or beyond one: as far from the map.
    step_ = min(point.w, w) > 1e-6 ? (point.place.xy * point.w + step_) / w - point.place.xy
                                   : vec2(-1e6);
    point.w = w;
#endif
    point.place += vec3(step_, dot(point.slope, step_));
    return point;
}

// What a unit of the light's plane is at a place, each of two ways: a step in texels.
void texelsAlong(int first, ShadowPoint point, out vec2 a, out vec2 b) {
    vec3 u = shadowMaps[first].alongU.xyz, v = shadowMaps[first].alongV.xyz;
    a = u.xy * point.scale;
    b = v.xy * point.scale;
#ifdef PERSPECTIVE_MAPS
    float perUnit = 1.0 / max(point.w, 1e-6);
    a = (a - point.place.xy * u.z) * perUnit;
    b = (b - point.place.xy * v.z) * perUnit;
#endif
}

// How many texels it is: the longest way.
float texelsPerUnit(int first, ShadowPoint point) {
    vec2 a, b;
    texelsAlong(first, point, a, b);
    return sqrt(max(dot(a, a), dot(b, b)));
}

float filteredShadow(int first, ShadowPoint point);

// Beyond this share of a map's side from its middle the next map is blended in.
const float blendFrom = 0.46;

// How much of a light reaches a place: 1 all, 0 nothing. Outside its maps it is lit.
//   first  the light's first map: MAPS_PER_LIGHT times its index. A constant where the call is
//          unrolled, so that the map's data is read once for all pixels, not for each.
//   point  in the light's first map
float shadowFactor(int first, ShadowPoint point) {
#if MAPS_PER_LIGHT > 1
    // The first map that holds the place decides, mixed with the next one toward its border. Which
    // that is costs no lookup; there is a second one only where some pixel nearby needs it.
    float factor = 1.0;
    float last = 1.0;
    float open = 1.0;
    int next = 0;
    for (int turn = 0; turn < 2; ++turn) {
        ShadowPoint here = point;
        float share = 0.0;
        int chosen = MAPS_PER_LIGHT;
        for (int k = MAPS_PER_LIGHT - 1; k >= 0; --k) {
            int map = first + k;
            vec4 fromFirst = shadowMaps[map].fromFirst;
            vec2 at = point.place.xy * fromFirst.xy + fromFirst.zw;
            vec2 off = abs(at * shadowMaps[map].size.w - 0.5) +
                       vec2(shadowMaps[map].alongU.w, shadowMaps[map].alongV.w);
            float inside = 0.5 - max(off.x, off.y);
            if (inside >= 0.0 && k >= next) {
                here = ShadowPoint(vec3(at, point.place.z), point.slope / fromFirst.xy,
                                   pagesOf(map), point.w, point.axial, fromFirst.xy);
                share = min(inside / (0.5 - blendFrom), 1.0);
                chosen = k;
            }
        }
        float lit = filteredShadow(first, here);
        last = share > 0.0 ? lit : last;
        factor += open * share * (last - 1.0);
        open *= 1.0 - share;
        next = chosen + 1;
        if (!(share > 0.0 && open > 0.0)) break;
    }
    return factor + open * (last - 1.0);
#else
    return filteredShadow(first, point);
#endif
}
)glsl";
}

}  // namespace gnomon::shadow
