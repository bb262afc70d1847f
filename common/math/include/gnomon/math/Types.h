#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace gnomon::math {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// An affine map, target-from-source: p -> linear * p + translation. Translation in double, so
/// that a far scene stays exact; the 3x3 part in float. 60 bytes on the wire.
struct Affine {
    dvec3 translation{0.0};
    mat3 linear{1.0F};
    friend bool operator==(const Affine&, const Affine&) = default;
};

dmat4 toMatrix(const Affine& affine) noexcept;
/// The upper three rows; the last row is taken to be 0 0 0 1.
Affine toAffine(const dmat4& matrix) noexcept;
/// Composed in double and rounded once.
Affine operator*(const Affine& a, const Affine& b) noexcept;
bool isFinite(const dvec3& point) noexcept;
bool isFinite(const dmat4& matrix) noexcept;
/// The inverse; where there is none that doubles can hold, not a number in every entry.
dmat4 inverted(const dmat4& matrix) noexcept;

/// An axis-aligned box; empty when min > max in any axis, as a new one is.
struct Box {
    dvec3 min{std::numeric_limits<double>::infinity()};
    dvec3 max{-std::numeric_limits<double>::infinity()};

    bool empty() const noexcept { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void add(const dvec3& point) noexcept {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void add(const Box& box) noexcept {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
    dvec3 centre() const noexcept { return (min + max) * 0.5; }
    dvec3 size() const noexcept { return max - min; }
    double radius() const noexcept { return glm::length(size()) * 0.5; }
    dvec3 corner(int i) const noexcept {
        return {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                (i & 4) != 0 ? max.z : min.z};
    }
    friend bool operator==(const Box&, const Box&) = default;
};

/// Bounds of the box's image; empty stays empty. @p targetFromSource is affine.
Box transformed(const Box& box, const dmat4& targetFromSource) noexcept;

/// Points with dot(normal, p) + offset >= 0 are inside. The normal has unit length.
struct Plane {
    dvec3 normal{0.0, 1.0, 0.0};
    double offset = 0.0;

    double distance(const dvec3& point) const noexcept { return glm::dot(normal, point) + offset; }
};

}  // namespace gnomon::math
