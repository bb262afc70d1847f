// One comparison a pixel, then a Gaussian over the image of all pixels' factors that stays on each
// surface: server/render/src/BlurGlsl.cpp. Its deviation is half the radius of pcf's disk, whose
// spread is the same. Nico Hempe. Diploma thesis on the OpenSG ShadowViewport. 2005, chapter 7.3.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_gauss() {
    return {.name = "gauss",
            .source = "Hempe 2005",
            .glsl = R"glsl(
// Radius of the kernel in texels of the finest map that was looked up, as many as quality asks for.
float kernelTexels = 0.0;

float filteredShadow(int first, ShadowPoint point) {
    float texels = kernelReach(first, point) * texelsPerUnit(first, point);
    kernelTexels = max(kernelTexels, texels * shadowMaps[first].kernel.w);
    return pageCompare(first, point);
}
)glsl",
            .onScreen = true};
}

}  // namespace gnomon::shadow
