// The share of a disk around a place that is lit, in metres across the light's rays, so that an
// edge is as soft in every map. Every sample is compared with the receiver's own plane where it is,
// and interpolated between texels, so that an edge moves through the kernel without steps. William
// Reeves, David Salesin, Robert Cook. Rendering Antialiased Shadows with Depth Maps. 1987.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_pcf() {
    return {.name = "pcf",
            .source = "Reeves, Salesin, Cook 1987",
            .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) {
    float radius = kernelReach(first, point);
    float texels = radius * texelsPerUnit(first, point);
    Around all = around(first, point, texels);
    float count = all.lit || all.shadowed ? 0.0 : samplesOf(first, 2.0 * texels);
    float lit = diskShadow(first, point, radius, vec2(1.0, 0.0), count);
    return all.lit ? 1.0 : all.shadowed ? 0.0 : lit;
}
)glsl",
            .shared = softGlsl(),
            .pyramid = &depthBounds()};
}

}  // namespace gnomon::shadow
