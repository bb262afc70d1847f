// The share of a kernel that is lit. By default the kernel is a disk in metres across the light's
// rays, so that an edge is as soft in every map; with samples a row it is the thesis' square in
// texels, all of it or a part, evenly. Every sample is compared with the receiver's own plane where
// it is, and interpolated between texels, so that an edge moves through the kernel without steps.
// William Reeves, David Salesin, Robert Cook. Rendering Antialiased Shadows with Depth Maps. 1987.
// Nico Hempe. Diploma thesis on the OpenSG ShadowViewport. 2005, chapter 7.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_pcf() {
    return {.name = "pcf",
            .source = "Reeves, Salesin, Cook 1987; Hempe 2005",
            .glsl = R"glsl(
float squareShadow(int first, ShadowPoint point, float width, int row) {
    float lit = 0.0;
    float between = width / float(row);
    vec3 corner = point.place;
    for (int y = 0; y < row; ++y)
        for (int x = 0; x < row; ++x) {
            vec2 by = (vec2(x, y) + 0.5) * between - 0.5 * width;
            point.place = corner + vec3(by, dot(point.slope, by));
            lit += pageCompare(first, point);
        }
    return lit / float(row * row);
}

float filteredShadow(int first, ShadowPoint point) {
    int row = int(shadowMaps[first].kernel.y);
    if (row > 0) return squareShadow(first, point, shadowMaps[first].kernel.x, row);
    float radius = min(shadowMaps[first].light.w / point.axial, shadowMaps[first].kernel.z);
    Around texels = around(first, point, radius * texelsPerUnit(first, point));
    if (texels.lit || texels.shadowed) return texels.lit ? 1.0 : 0.0;
    return diskShadow(first, point, radius);
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
