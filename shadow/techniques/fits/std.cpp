// The standard shadow map, focused: a light camera around what is both visible and lit.
// Lance Williams. Casting Curved Shadows on Curved Surfaces. 1978.
// Focusing: Stefan Brabec, Thomas Annen, Hans-Peter Seidel. Practical Shadow Mapping. 2002. Here
// the body is what is seen of the scene's chunks, and the map is turned so that the rectangle
// around it is the smallest.
#include "../../fit/src/Plain.h"

namespace gnomon::shadow_fit {

FitInfo describe_std() {
    return {.name = "std", .source = "Williams 1978; Brabec et al. 2002", .fit = plainFit};
}

}  // namespace gnomon::shadow_fit
