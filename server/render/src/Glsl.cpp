#include "Glsl.h"

namespace gnomon::render::glsl {

std::string_view version() noexcept { return "#version 450 core\n"; }

std::string_view meshVertex() noexcept {
    return R"glsl(
layout(location = 0) in vec3 position;
#ifdef HAS_NORMALS
layout(location = 1) in vec3 normal;
#endif
#ifdef HAS_TEXCOORDS
layout(location = 2) in vec2 texCoord;
#endif
#ifdef HAS_TANGENTS
layout(location = 3) in vec4 tangent;
#endif
#ifdef HAS_COLORS
layout(location = 4) in vec4 color;
#endif
layout(location = 5) in vec4 rowX;  // originFromLocal
layout(location = 6) in vec4 rowY;
layout(location = 7) in vec4 rowZ;
layout(location = 8) in uvec4 info;

layout(location = 0) uniform mat4 clipFromOrigin;

#ifndef DEPTH_ONLY
out vec3 vPosition;
#ifdef HAS_NORMALS
out vec3 vNormal;
#endif
#ifdef HAS_TANGENTS
out vec4 vTangent;
#endif
#ifdef SCOPED_LIGHTS
flat out uvec2 vLights;
#endif
#if SHADOW_PLACES > 0
// A light's place in its map is a projective image of the position: it can be interpolated, which
// is cheaper than finding it for each pixel.
#ifdef PERSPECTIVE_MAPS
#define PLACE(p) (p)
out vec4 vPlace[SHADOW_PLACES];
#else
#define PLACE(p) (p).xyz
out vec3 vPlace[SHADOW_PLACES];
#endif
#endif
#endif
#ifdef HAS_TEXCOORDS
out vec2 vTexCoord;
#endif
#ifdef HAS_COLORS
out vec4 vColor;
#endif

void main() {
    vec4 p = vec4(position, 1.0);
    vec3 world = vec3(dot(rowX, p), dot(rowY, p), dot(rowZ, p));
    gl_Position = clipFromOrigin * vec4(world, 1.0);
#ifdef HAS_TEXCOORDS
    vTexCoord = texCoord;
#endif
#ifdef HAS_COLORS
    vColor = color;
#endif
#ifndef DEPTH_ONLY
    vPosition = world;
#ifdef HAS_NORMALS
    // Normals go by the cofactors: right for any scale, mirrored and singular ones too.
    vec3 a = rowX.xyz, b = rowY.xyz, c = rowZ.xyz;
    vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    float flip = dot(a, bc) < 0.0 ? -1.0 : 1.0;
    vNormal = flip * vec3(dot(bc, normal), dot(ca, normal), dot(ab, normal));
#endif
#ifdef HAS_TANGENTS
    vTangent = vec4(dot(rowX.xyz, tangent.xyz), dot(rowY.xyz, tangent.xyz),
                    dot(rowZ.xyz, tangent.xyz), tangent.w);
#endif
#ifdef SCOPED_LIGHTS
    vLights = info.xy;
#endif
#if SHADOW_PLACES > 0
    for (int i = 0; i < SHADOW_PLACES; ++i)
        vPlace[i] = PLACE(shadowPlace(i * MAPS_PER_LIGHT, world));
#endif
#endif
}
)glsl";
}

std::string_view meshCommon() noexcept {
    return R"glsl(
struct Light {
    vec4 position;     // xyz relative to the origin, w: range (0: none)
    vec4 direction;    // xyz unit, from the light; w: 0 directional, 1 point, 2 spot
    vec4 color;        // rgb times intensity
    vec4 attenuation;  // constant, linear, quadratic
    vec4 cone;         // strength = (x * cosine + y)^2
    vec4 ambient;      // w: 1 where it has shadow maps, else 0
    uvec4 index;       // x: among the scene's lights
};
layout(std140, binding = 1) uniform LightBlock {
    Light lights[64];
};
layout(std140, binding = 2) uniform ViewBlock {
    vec4 eye;            // relative to the origin; w: number of lights
    vec4 ambientMiddle;  // of sky and ground
    vec4 ambientHalf;    // from there to the sky
    vec4 shade;          // what a whole shadow takes of a light
    ivec4 factorImages;  // xy: the pixel of theirs that the window's first one is
};
layout(std140, binding = 3) uniform MaterialBlock {
    vec4 diffuse;
    vec4 specular;   // rgb normalized for the shininess, w: half the shininess
    vec4 emissive;   // w: alpha cutoff, < 0 where not masked
    vec4 texRowS;    // w: normal scale
    vec4 texRowT;
} material;

#ifdef DIFFUSE_MAP
layout(binding = 0) uniform sampler2D diffuseMap;
#endif
#ifdef NORMAL_MAP
layout(binding = 1) uniform sampler2D normalMap;
#endif
#ifdef EMISSIVE_MAP
layout(binding = 2) uniform sampler2D emissiveMap;
#endif

#ifdef HAS_TEXCOORDS
in vec2 vTexCoord;
vec2 textureCoordinate() {
    vec3 t = vec3(vTexCoord, 1.0);
    return vec2(dot(material.texRowS.xyz, t), dot(material.texRowT.xyz, t));
}
#endif
#ifdef HAS_COLORS
in vec4 vColor;
#endif

vec4 surfaceColor() {
    vec4 color = material.diffuse;
#ifdef DIFFUSE_MAP
    color *= texture(diffuseMap, textureCoordinate());
#endif
#ifdef HAS_COLORS
    color *= vColor;
#endif
#ifdef ALPHA_MASK
    if (color.a < material.emissive.w) discard;
#endif
    return color;
}

vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

// Direction to a light and what reaches `position` of it without shadows; zero where none does.
vec3 lightReaching(int i, vec3 position, out vec3 toLight) {
    if (lights[i].direction.w == 0.0) {
        toLight = -lights[i].direction.xyz;
        return lights[i].color.rgb;
    }
    vec3 way = lights[i].position.xyz - position;
    float square = max(dot(way, way), 1e-12);
    float distance = sqrt(square);
    toLight = way / distance;
    vec4 k = lights[i].attenuation;
    float weight = 1.0 / max(k.x + k.y * distance + k.z * square, 1e-6);
    float range = lights[i].position.w;
    if (range > 0.0) {
        // Reaches zero at the range. Source: Brian Karis. Real Shading in Unreal Engine 4. 2013.
        float q = square / (range * range);
        float window = clamp(1.0 - q * q, 0.0, 1.0);
        weight *= window * window;
    }
    if (lights[i].direction.w == 2.0) {
        float c = dot(-toLight, lights[i].direction.xyz);
        float t = clamp(lights[i].cone.x * c + lights[i].cone.y, 0.0, 1.0);
        weight *= t * t;
    }
    return lights[i].color.rgb * weight;
}

// Whether anything of a light arrives at all: within its range and a spot's cone.
bool shinesAt(int i, vec3 position) {
    if (lights[i].direction.w == 0.0) return true;
    vec3 way = position - lights[i].position.xyz;
    float square = dot(way, way);
    float range = lights[i].position.w;
    if (range > 0.0 && square >= range * range) return false;
    float c = dot(way, lights[i].direction.xyz) * inversesqrt(max(square, 1e-12));
    return lights[i].direction.w != 2.0 || lights[i].cone.x * c + lights[i].cone.y > 0.0;
}
)glsl";
}

std::string_view factorLookup() noexcept {
    return R"glsl(
layout(binding = 10) uniform sampler2DArray shadowFactors;
#define ShadowPoint int
int foundPoint(int light, vec3 position, vec3 normal) { return 0; }
float shadowFactor(int light, int point) {
    ivec2 pixel = ivec2(gl_FragCoord.xy) + factorImages.xy;
    return texelFetch(shadowFactors, ivec3(pixel, light), 0).r;
}
)glsl";
}

std::string_view meshPlaces() noexcept {
    return R"glsl(
in vec3 vPosition;
#if SHADOW_PLACES > 0
#ifdef PERSPECTIVE_MAPS
in vec4 vPlace[SHADOW_PLACES];
vec4 placeOf(int i) { return vPlace[i]; }
#else
in vec3 vPlace[SHADOW_PLACES];
vec4 placeOf(int i) { return vec4(vPlace[i], 1.0); }
#endif
#endif
// Where the surface is in light i's first shadow map. With the face's normal at hand, of any length.
#ifdef SHADOWS
#define FOUND(i) foundPoint((i) * MAPS_PER_LIGHT, vPosition, unit(face))
#else
#define FOUND(i) 0
#endif
#if SHADOW_PLACES > 0
#define INTERPOLATED(i) interpolatedPoint((i) * MAPS_PER_LIGHT, placeOf(i))
#else
#define INTERPOLATED(i) 0
#endif
)glsl";
}

std::string_view meshColor() noexcept {
    return R"glsl(
#ifdef HAS_NORMALS
in vec3 vNormal;
#endif
#ifdef HAS_TANGENTS
in vec4 vTangent;
#endif
#ifdef SCOPED_LIGHTS
flat in uvec2 vLights;
#endif
layout(location = 0) out vec4 outColor;

#ifdef NORMAL_MAP
vec3 mappedNormal(vec3 normal, vec2 uv) {
    vec3 m = texture(normalMap, uv).xyz * 2.0 - 1.0;
    m.xy *= material.texRowS.w;
#ifdef HAS_TANGENTS
    vec3 t = vTangent.xyz;
    float hand = vTangent.w;
#else
    // Frame from derivatives. Source: Christian Schueler. Normal Mapping Without Precomputed
    // Tangents. ShaderX5, 2006.
    vec3 px = dFdx(vPosition), py = dFdy(vPosition);
    vec2 ux = dFdx(uv), uy = dFdy(uv);
    vec3 t = px * uy.y - py * ux.y;
    // A glTF image has v downward: the bitangent is the normal crossed with the tangent.
    float hand = (ux.x * uy.y - uy.x * ux.y) < 0.0 ? 1.0 : -1.0;
    t *= -hand;
#endif
    t -= normal * dot(normal, t);
    float length2 = dot(t, t);
    if (!(length2 > 1e-20)) return normal;
    t *= inversesqrt(length2);
    return normalize(t * m.x + cross(normal, t) * (hand * m.y) + normal * m.z);
}
#endif

#ifndef UNLIT
// What one light adds.
#ifndef SHADOWS
#define ShadowPoint int
#endif
//   point  where the surface is in the light's first shadow map
vec3 lit(int i, vec3 toLight, vec3 reaching, ShadowPoint point, vec3 normal, vec3 face, vec3 toEye,
         vec3 diffuse) {
#ifdef SCOPED_LIGHTS
    uint bit = lights[i].index.x;
    if (((bit < 32u ? vLights.x : vLights.y) & (1u << (bit & 31u))) == 0u) return vec3(0.0);
#endif
    vec3 ambient = lights[i].ambient.rgb * diffuse;
    float cosine = dot(normal, toLight);
    reaching *= max(cosine, 0.0);
#ifdef SHADOWS
    if (cosine > 0.0 && i < SHADOW_LIGHTS) {
        // A face that is turned away is in its own shadow, whatever its normal map says.
        float factor = dot(face, toLight) > 0.0 ? shadowFactor(i * MAPS_PER_LIGHT, point) : 0.0;
        reaching -= reaching * shade.rgb * (lights[i].ambient.w * (1.0 - factor));
    }
#endif
    // Energy-conserving Blinn-Phong. Source: Fabian Giesen. Phong Normalization Factor Derivation.
    // 2009. Of the halfway vector only the square of its cosine is needed.
    float d = max(cosine + dot(normal, toEye), 0.0);
    float square = d * d / max(2.0 + 2.0 * dot(toLight, toEye), 1e-6);
    float gloss = exp2(material.specular.w * log2(max(square, 1e-12)));
    return ambient + reaching * (diffuse + material.specular.rgb * gloss);
}
#endif

void main() {
    vec4 color = surfaceColor();
#ifdef UNLIT
    outColor = vec4(color.rgb, color.a);
#else
    // The face's own normal, of any length, on the side that is seen: for what a shadow map can
    // know.
    vec3 toEye = eye.xyz - vPosition;
    vec3 face = cross(dFdx(vPosition), dFdy(vPosition));
    face = dot(face, toEye) < 0.0 ? -face : face;
    toEye = unit(toEye);
#ifdef HAS_NORMALS
    vec3 normal = unit(vNormal);
    normal = dot(normal, face) < 0.0 ? -normal : normal;
#else
    vec3 normal = unit(face);
#endif
#ifdef NORMAL_MAP
    normal = mappedNormal(normal, textureCoordinate());
#endif
    vec3 diffuse = color.rgb;
    vec3 radiance = (ambientMiddle.rgb + ambientHalf.rgb * normal.y) * diffuse;
    // Directional lights come first. The number of lights is fixed in the program and each call is
    // written out: a constant index is read once for all pixels.
#define DIRECTIONAL(i, point)                                                                  \
    radiance += lit(i, -lights[i].direction.xyz, lights[i].color.rgb, point(i), normal, face, \
                    toEye, diffuse);
#define OTHER(i, point)                                                                  \
    {                                                                                    \
        vec3 toLight;                                                                    \
        vec3 reaching = lightReaching(i, vPosition, toLight);                            \
        radiance += lit(i, toLight, reaching, point(i), normal, face, toEye, diffuse);   \
    }
    DIRECTIONAL_LIGHTS
    OTHER_LIGHTS
#ifdef MANY_LIGHTS
    int count = int(eye.w);
    for (int i = MANY_LIGHTS; i < count; ++i) OTHER(i, FOUND)
#endif
    vec3 glow = material.emissive.rgb;
#ifdef EMISSIVE_MAP
    glow *= texture(emissiveMap, textureCoordinate()).rgb;
#endif
    outColor = vec4(radiance + glow, color.a);
#endif
}
)glsl";
}

std::string_view meshDepth() noexcept {
    return R"glsl(
void main() { surfaceColor(); }
)glsl";
}

std::string_view meshFactor() noexcept {
    return R"glsl(
layout(location = 0) out float outFactor;

void main() {
    surfaceColor();
    vec3 toEye = eye.xyz - vPosition;
    vec3 face = cross(dFdx(vPosition), dFdy(vPosition));
    face = dot(face, toEye) < 0.0 ? -face : face;
    vec3 toLight;
    lightReaching(0, vPosition, toLight);
    float lit = dot(face, toLight) > 0.0 && shinesAt(0, vPosition) ? 1.0 : 0.0;
#if SHADOW_PLACES > 0
    ShadowPoint point = interpolatedPoint(0, placeOf(0));
    if (lit > 0.0 && lights[0].ambient.w > 0.0) lit = shadowFactor(0, point);
#endif
#ifdef FACTOR_IMAGES
    if (lights[0].ambient.w > 0.0) lit *= shadowFactor(0, 0);
#endif
    // 128 means that there is no surface.
    float byteValue = floor(lit * 255.0 + 0.5);
    outFactor = (byteValue == 128.0 ? 127.0 : byteValue) / 255.0;
}
)glsl";
}

std::string_view coverVertex() noexcept {
    return R"glsl(
out vec2 vShare;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    vShare = corner;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)glsl";
}

std::string_view backgroundVertex() noexcept {
    // Two vertices a stop; colour between stops is interpolated by the rasterizer, which costs less
    // than a search in each pixel.
    return R"glsl(
layout(location = 0) uniform vec2 part;      // bottom and height of this tile in the whole picture
layout(location = 1) uniform int stopCount;
layout(location = 2) uniform vec4 stops[16]; // rgb, position; ascending
out vec3 vColor;
void main() {
    int row = gl_VertexID >> 1;
    vec4 stop = stops[clamp(row - 1, 0, stopCount - 1)];
    // The first row is below everything, the last above: what is outside all stops.
    float at = row == 0 ? -1.0 : row == stopCount + 1 ? 2.0 : stop.w;
    vColor = stop.rgb;
    gl_Position = vec4((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (at - part.x) / part.y * 2.0 - 1.0, 0.0, 1.0);
}
)glsl";
}

std::string_view background() noexcept {
    return R"glsl(
in vec3 vColor;
layout(location = 0) out vec4 outColor;
void main() { outColor = vec4(vColor, 1.0); }
)glsl";
}

std::string_view foregroundVertex() noexcept {
    return R"glsl(
layout(location = 0) uniform vec4 rect;  // clip space: left, bottom, width, height
out vec2 vTexCoord;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vTexCoord = vec2(corner.x, 1.0 - corner.y);
    gl_Position = vec4(rect.xy + corner * rect.zw, 0.0, 1.0);
}
)glsl";
}

std::string_view foreground() noexcept {
    return R"glsl(
in vec2 vTexCoord;
layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 outColor;
void main() { outColor = texture(image, vTexCoord); }
)glsl";
}

std::string_view depthRange() noexcept {
    return R"glsl(
layout(binding = 3) uniform sampler2D depthImage;
layout(location = 0) uniform ivec4 pixels;
layout(location = 0) out vec2 outRange;

void main() {
    ivec2 first = pixels.xy + ivec2(gl_FragCoord.xy) * 32;
    ivec2 end = min(first + 32, pixels.xy + pixels.zw);
    vec2 range = vec2(1.0, 0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            float depth = texelFetch(depthImage, ivec2(x, y), 0).r;
            if (depth > 0.0) range = vec2(min(range.x, depth), max(range.y, depth));
        }
    }
    outRange = range;
}
)glsl";
}

std::string_view combine() noexcept {
    // What the foreign shader drew is taken as its own sum over all lights: the share of it that
    // each light would have in ours is darkened by that light's factor, and what is ambient is
    // left.
    return R"glsl(
in vec2 vShare;
layout(binding = 3) uniform sampler2D depthImage;
layout(location = 0) uniform mat4 originFromClip;
layout(location = 4) uniform ivec4 viewportPixels;
layout(location = 0) out vec4 outColor;

vec3 positionAt(ivec2 pixel, float depth) {
    vec2 share = (vec2(pixel - viewportPixels.xy) + 0.5) / vec2(viewportPixels.zw);
    vec4 p = originFromClip * vec4(share * 2.0 - 1.0, depth, 1.0);
    return p.xyz / p.w;
}

// Step to the neighbour, on the side whose depth is nearer to ours: not across an edge.
vec3 stepAlong(ivec2 pixel, ivec2 by, vec3 here, float depth) {
    ivec2 low = viewportPixels.xy, high = low + viewportPixels.zw - 1;
    float after = texelFetch(depthImage, clamp(pixel + by, low, high), 0).r;
    float before = texelFetch(depthImage, clamp(pixel - by, low, high), 0).r;
    bool useAfter = abs(after - depth) <= abs(before - depth);
    return useAfter ? positionAt(pixel + by, after) - here : here - positionAt(pixel - by, before);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthImage, pixel, 0).r;
    vec3 position = positionAt(pixel, depth);
    vec3 normal = cross(stepAlong(pixel, ivec2(1, 0), position, depth),
                        stepAlong(pixel, ivec2(0, 1), position, depth));
    normal = dot(normal, eye.xyz - position) < 0.0 ? -normal : normal;
    normal = unit(normal);
    vec3 all = ambientMiddle.rgb + ambientHalf.rgb * normal.y;
    vec3 kept = all;
    int count = int(eye.w);
    for (int i = 0; i < count; ++i) {
        vec3 toLight;
        vec3 reaching = lightReaching(i, position, toLight);
        all += lights[i].ambient.rgb;
        kept += lights[i].ambient.rgb;
        float cosine = dot(normal, toLight);
        // A foreign shader may light what faces away; such a light's share is left alone.
        if (cosine <= 0.0) continue;
        reaching *= cosine;
        all += reaching;
        float lit = 1.0;
#ifdef SHADOWS
        if (lights[i].ambient.w > 0.0)
            lit = shadowFactor(i * MAPS_PER_LIGHT,
                               foundPoint(i * MAPS_PER_LIGHT, position, normal));
#endif
        kept += reaching * (1.0 - shade.rgb * (1.0 - lit));
    }
    outColor = vec4(kept / max(all, vec3(1e-6)), 1.0);
}
)glsl";
}

}  // namespace gnomon::render::glsl
