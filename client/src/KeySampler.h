#pragma once

#include <gnomon/math/Types.h>
#include <gnomon/scene/Imported.h>

#include <span>

namespace gnomon::client {

/// One channel's keys: glTF 2.0, section 3.11 and appendix C.
struct Keys {
    scene::AnimationChannel::Interpolation interpolation = {};
    std::span<const float> times = {};   ///< seconds, ascending, at least one
    std::span<const float> values = {};  ///< components a key, three times that for cubicSpline
};

/// True where there are as many values as the keys need.
bool complete(const Keys& keys, std::size_t components) noexcept;

/// The value at @p time; before the first and after the last key theirs. @pre complete(keys, 3)
math::dvec3 sampleVector(const Keys& keys, double time) noexcept;
/// A unit quaternion x y z w, on the shorter way between keys. @pre complete(keys, 4)
math::dvec4 sampleRotation(const Keys& keys, double time) noexcept;

}  // namespace gnomon::client
