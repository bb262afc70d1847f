#include "Shapes.h"

#include <cmath>

namespace gnomon::importer {

void Shape::add(const Shape& other, const math::vec3& offset) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& p : other.positions) positions.push_back(p + offset);
    for (const auto i : other.indices) indices.push_back(i + first);
}

Shape Shape::unshared() const {
    Shape out;
    for (const auto i : indices) {
        out.indices.push_back(static_cast<std::uint32_t>(out.positions.size()));
        out.positions.push_back(positions[i]);
    }
    return out;
}

Shape cube() {
    Shape shape;
    for (std::uint32_t i = 0; i < 8; ++i)
        shape.positions.emplace_back(i & 1U ? 1.0F : 0.0F, i & 2U ? 1.0F : 0.0F,
                                     i & 4U ? 1.0F : 0.0F);
    const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads)
        shape.indices.insert(shape.indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    return shape;
}

Shape sphere(std::uint32_t columns, std::uint32_t rows) {
    Shape shape;
    const auto pi = 3.14159265358979;
    shape.positions.emplace_back(0.0F, 1.0F, 0.0F);
    for (std::uint32_t r = 1; r < rows; ++r) {
        for (std::uint32_t c = 0; c < columns; ++c) {
            const double theta = pi * r / rows;
            const double phi = 2.0 * pi * c / columns;
            shape.positions.emplace_back(math::dvec3{std::sin(theta) * std::cos(phi),
                                                     std::cos(theta),
                                                     -std::sin(theta) * std::sin(phi)});
        }
    }
    shape.positions.emplace_back(0.0F, -1.0F, 0.0F);
    const auto at = [&](std::uint32_t r, std::uint32_t c) {
        if (r == 0) return 0U;
        if (r == rows) return static_cast<std::uint32_t>(shape.positions.size() - 1);
        return 1 + (r - 1) * columns + c % columns;
    };
    for (std::uint32_t r = 0; r < rows; ++r) {
        for (std::uint32_t c = 0; c < columns; ++c) {
            if (r + 1 < rows)
                shape.indices.insert(shape.indices.end(),
                                     {at(r, c), at(r + 1, c), at(r + 1, c + 1)});
            if (r > 0)
                shape.indices.insert(shape.indices.end(),
                                     {at(r, c), at(r + 1, c + 1), at(r, c + 1)});
        }
    }
    return shape;
}

Shape plane(std::uint32_t n) {
    Shape shape;
    for (std::uint32_t z = 0; z <= n; ++z)
        for (std::uint32_t x = 0; x <= n; ++x)
            shape.positions.emplace_back(static_cast<float>(x), 0.0F, static_cast<float>(z));
    const auto at = [n](std::uint32_t x, std::uint32_t z) { return z * (n + 1) + x; };
    for (std::uint32_t z = 0; z < n; ++z)
        for (std::uint32_t x = 0; x < n; ++x)
            shape.indices.insert(shape.indices.end(), {at(x, z), at(x, z + 1), at(x + 1, z + 1),
                                                       at(x, z), at(x + 1, z + 1), at(x + 1, z)});
    return shape;
}

}  // namespace gnomon::importer
