#pragma once

#include <gnomon/math/Types.h>

#include <vector>

namespace gnomon::shadow_fit {

/// Andrew's monotone chain. Counter-clockwise, without the points on its edges; of fewer than three
/// different points, or points on a line, what is left of them.
std::vector<math::dvec2> convexHull(std::vector<math::dvec2> points);

/// The hull of all points within a distance of a hull's, and a little more: each corner becomes
/// those of an octagon.
std::vector<math::dvec2> dilated(std::vector<math::dvec2> hull, double by);

}  // namespace gnomon::shadow_fit
