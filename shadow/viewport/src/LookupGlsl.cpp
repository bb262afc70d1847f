#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

std::string_view lookupGlsl() noexcept {
    // The depth offset is along the receiver's normal. A lookup reaches r + 1/2 texels to each
    // side, over which a plane at angle a to the light rises sqrt(2) (r + 1/2) t tan(a); moving the
    // receiver by o along its normal clears o / cos(a). The small constant covers rounding where
    // the plane faces the light. Source: Daniel Holbert. Saying Goodbye to Shadow Acne. GDC 2011.
    return R"glsl(
struct ShadowMap {
    mat4 clipFromOrigin;
    vec4 texel;   // x: metres a texel at w = 1, y: reach in texels, z: map size, w: page size
    uvec4 pages;  // x: pages a side, y: first entry of the table, z: the layer where x is 1
};
layout(std140, binding = 4) uniform ShadowMapBlock { ShadowMap shadowMaps[128]; };
layout(std140, binding = 5) uniform PageTableBlock { uvec4 pageTable[1024]; };
layout(binding = 8) uniform sampler2DArrayShadow shadowPages;

const uint pageMissing = 0xffffffffu;

// Bilinear comparison at a position in texels of the map. Lit where nothing was drawn.
float pageCompare(uint map, vec2 texel, float depth) {
    float pageSize = shadowMaps[map].texel.w;
#ifdef PAGED_MAPS
    uint side = shadowMaps[map].pages.x;
    uvec2 page = uvec2(clamp(texel / pageSize, vec2(0.0), vec2(float(side) - 1.0)));
    uint entry = shadowMaps[map].pages.y + page.y * side + page.x;
    uint layer = pageTable[entry >> 2u][entry & 3u];
    texel -= vec2(page) * pageSize;
#else
    uint layer = shadowMaps[map].pages.z;
#endif
    if (layer == pageMissing) return 1.0;
    return texture(shadowPages, vec4((texel + 1.0) / (pageSize + 2.0), float(layer), depth));
}

float filteredShadow(uint map, vec3 q);

// How much of a light reaches a surface: 1 all, 0 nothing. The first of its maps that holds the
// place decides; outside all of them it is lit.
//   first     the light's first map: MAPS_PER_LIGHT times its index. A constant where the call is
//             unrolled, so that the map's data is read once for all pixels, not for each.
//   count     how many maps it has
//   position  relative to the group's origin
//   normal    of the surface, unit, on the side that is seen
//   nDotL     cosine to the light, > 0
float shadowFactor(int first, int count, vec3 position, vec3 normal, float nDotL) {
    float square = 1.0 - nDotL * nDotL;
    float factor = 1.0;
    bool found = false;
    for (int k = 0; k < MAPS_PER_LIGHT; ++k) {
        uint map = uint(first + k);
        mat4 m = shadowMaps[map].clipFromOrigin;
        vec4 texelInfo = shadowMaps[map].texel;
        float w = m[0].w * position.x + m[1].w * position.y + m[2].w * position.z + m[3].w;
        // A spot's map measures depth along its axis: a surface may face the light and yet be steep
        // in the map. A parallel light's rows have no w, and its axis is the light's direction.
        vec3 axis = vec3(m[0].w, m[1].w, m[2].w);
        float along = dot(axis, normal);
        float sine = sqrt(max(max(square, dot(axis, axis) - along * along), 0.0));
        float offset = texelInfo.x * w * (0.05 + 1.4142 * texelInfo.y * sine);
        vec4 clip = m * vec4(position + normal * offset, 1.0);
        vec3 q = clip.xyz / clip.w;
        q.xy = q.xy * 0.5 + 0.5;
        bool inside = k < count && w > 0.0 && all(greaterThanEqual(q.xy, vec2(0.0))) &&
                      all(lessThanEqual(q.xy, vec2(1.0)));
        if (inside && !found) factor = filteredShadow(map, q);
        found = found || inside;
    }
    return factor;
}
)glsl";
}

}  // namespace gnomon::shadow
