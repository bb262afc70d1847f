// The standard shadow map, focused: a light camera around what is both visible and lit.
// Lance Williams. Casting Curved Shadows on Curved Surfaces. 1978.
// Focusing: Stefan Brabec, Thomas Annen, Hans-Peter Seidel. Practical Shadow Mapping. 2002. Here
// the body is the exact convex intersection, and a parallel light's map is turned so that the
// rectangle around it is the smallest (Herbert Freeman, Ruth Shapira. Determining the Minimum-Area
// Encasing Rectangle for an Arbitrary Closed Curve. 1975).
#include <gnomon/shadow_fit/Fit.h>

#include "../../fit/src/LightCamera.h"

namespace gnomon::shadow_fit {
namespace {

Fitted fit(const FitInput& input) {
    const auto receivers = receiverPoints(input);
    if (receivers.empty()) return {};
    return {.maps = {{.clipFromWorld = input.light.kind == LightKind::directional
                                           ? parallelCamera(input, receivers)
                                           : spotCamera(input, receivers)}}};
}

}  // namespace

FitInfo describe_std() {
    return {.name = "std", .source = "Williams 1978; Brabec et al. 2002", .fit = fit};
}

}  // namespace gnomon::shadow_fit
