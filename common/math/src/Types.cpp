#include <gnomon/math/Types.h>

#include <cmath>

namespace gnomon::math {

dmat4 toMatrix(const Affine& affine) noexcept {
    dmat4 matrix{dmat3{affine.linear}};
    matrix[3] = dvec4{affine.translation, 1.0};
    return matrix;
}

Affine toAffine(const dmat4& matrix) noexcept {
    return {.translation = dvec3{matrix[3].x, matrix[3].y, matrix[3].z},
            .linear = mat3{dmat3{matrix}}};
}

Affine operator*(const Affine& a, const Affine& b) noexcept {
    const dmat3 linear{a.linear};
    return {.translation = linear * b.translation + a.translation,
            .linear = mat3{linear * dmat3{b.linear}}};
}

bool isFinite(const dvec3& point) noexcept {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

bool isFinite(const dmat4& matrix) noexcept {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

Box transformed(const Box& box, const dmat4& targetFromSource) noexcept {
    if (box.empty()) return {};
    // Each axis of the image is a sum of intervals. Source: James Arvo. Transforming Axis-Aligned
    // Bounding Boxes. Graphics Gems, 1990.
    Box image;
    image.min = image.max = dvec3{targetFromSource[3]};
    for (int axis = 0; axis < 3; ++axis) {
        const dvec3 column{targetFromSource[axis]};
        const dvec3 a = column * box.min[axis];
        const dvec3 b = column * box.max[axis];
        image.min += glm::min(a, b);
        image.max += glm::max(a, b);
    }
    return image;
}

}  // namespace gnomon::math
