// One comparison a pixel, interpolated between the four nearest texels.
// William Reeves, David Salesin, Robert Cook. Rendering Antialiased Shadows with Depth Maps. 1987.
#include <gnomon/shadow/Filter.h>

namespace gnomon::shadow {

FilterInfo describe_hard() {
    return {.name = "hard", .source = "Reeves, Salesin, Cook 1987", .glsl = R"glsl(
float filteredShadow(int first, ShadowPoint point) { return pageCompare(first, point); }
)glsl"};
}

}  // namespace gnomon::shadow
