#include <gnomon/math/Types.h>

#include <cmath>
#include <utility>

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

dmat4 inverted(const dmat4& matrix) noexcept {
    // Gauss and Jordan, on columns, with the largest pivot of each row. Unlike cofactors it neither
    // overflows nor divides by a determinant that has underflowed to zero.
    dmat4 left = matrix;
    dmat4 right{1.0};
    const dmat4 none{dvec4{std::numeric_limits<double>::quiet_NaN()},
                     dvec4{std::numeric_limits<double>::quiet_NaN()},
                     dvec4{std::numeric_limits<double>::quiet_NaN()},
                     dvec4{std::numeric_limits<double>::quiet_NaN()}};
    for (int i = 0; i < 4; ++i) {
        int pivot = i;
        for (int column = i + 1; column < 4; ++column)
            if (std::abs(left[column][i]) > std::abs(left[pivot][i])) pivot = column;
        if (!(std::abs(left[pivot][i]) > 0.0)) return none;
        std::swap(left[i], left[pivot]);
        std::swap(right[i], right[pivot]);
        const double by = left[i][i];  // the pivot, not zero
        left[i] /= by;
        right[i] /= by;
        for (int column = 0; column < 4; ++column) {
            if (column == i) continue;
            const double times = left[column][i];
            left[column] -= left[i] * times;
            right[column] -= right[i] * times;
        }
    }
    return isFinite(right) ? right : none;
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
