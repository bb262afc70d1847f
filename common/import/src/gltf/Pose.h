#pragma once

#include <gnomon/math/Types.h>

#include "gltf/Json.h"
#include "input/Report.h"

namespace gnomon::importer {

/// A node's place below its parent.
struct GltfPose {
    math::dvec3 translation{0.0};
    math::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x y z w
    math::dvec3 scale{1.0};
    bool isMatrix = false;  ///< given as a matrix: the three above are not its own
    math::Affine parentFromNode = {};
};

/// The 3x3 part of a rotation, times a scale.
math::dmat3 rotationTimesScale(const math::dvec4& quaternion, const math::dvec3& scale);

/// Refuses what is not finite as float; a quaternion of length zero becomes no rotation.
GltfPose gltfPose(const JsonView& node, Report& report);

}  // namespace gnomon::importer
