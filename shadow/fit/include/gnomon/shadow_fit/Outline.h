#pragma once

#include <gnomon/math/Types.h>

#include <vector>

namespace gnomon::shadow_fit {

/// Andrew's monotone chain. Counter-clockwise, without the points on its edges; of fewer than three
/// different points, or points on a line, what is left of them.
std::vector<math::dvec2> convexHull(std::vector<math::dvec2> points);

}  // namespace gnomon::shadow_fit
