#include <gnomon/base/Error.h>
#include <gnomon/demo/Shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "Polygon.h"

namespace gnomon::demo {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Distances along a profile, for texture coordinates.
std::vector<float> arcLengths(std::span<const glm::vec2> profile) {
    std::vector<float> lengths{0.0F};
    for (std::size_t i = 1; i < profile.size(); ++i) {
        lengths.push_back(lengths.back() + glm::distance(profile[i - 1], profile[i]));
    }
    return lengths;
}

float widest(std::span<const glm::vec2> profile) {
    float radius = 0.0F;
    for (const glm::vec2& p : profile) radius = std::max(radius, p.x);
    return radius;
}

}  // namespace

glm::vec3 onCircle(float radius, float angle, float height) {
    return {radius * std::sin(angle), height, -radius * std::cos(angle)};
}

glm::mat4 turned(float angle) {
    return glm::rotate(glm::mat4{1.0F}, -angle, glm::vec3{0.0F, 1.0F, 0.0F});
}

void addGrid(Mesh& mesh, int rows, int columns, bool wrap, const GridFunction& at) {
    const auto vertex = [&](int row, int column) {
        Vertex v = at(row, column);
        if (wrap && column == columns) v.position = at(row, 0).position;
        return v;
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            addQuad(mesh, vertex(row, column), vertex(row, column + 1), vertex(row + 1, column + 1),
                    vertex(row + 1, column));
        }
    }
}

Mesh box(const glm::vec3& low, const glm::vec3& high, float uvPerMetre, float bevel) {
    const glm::vec3 centre = (low + high) * 0.5F;
    const glm::vec3 half = (high - low) * 0.5F;
    // The corner of the face across `axis` at the box corner with these signs.
    const auto corner = [&](const glm::vec3& signs, int axis) {
        glm::vec3 p = half;
        for (int k = 0; k < 3; ++k) {
            if (k != axis) p[k] -= bevel;
        }
        return centre + signs * p;
    };
    Mesh mesh;
    const auto add = [&](std::initializer_list<glm::vec3> loop) {
        std::vector<glm::vec3> corners{loop};
        // One order of the loop faces outward; take it.
        const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::dot(normal, corners[0] + corners[1] + corners[2] - 3.0F * centre) < 0.0F) {
            std::reverse(corners.begin(), corners.end());
        }
        addPolygon(mesh, corners, uvPerMetre);
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int w = (axis + 2) % 3;
        for (const float side : {-1.0F, 1.0F}) {
            const auto signs = [&](float a, float b) {
                glm::vec3 s{0.0F};
                s[axis] = side;
                s[u] = a;
                s[w] = b;
                return s;
            };
            add({corner(signs(-1, -1), axis), corner(signs(1, -1), axis), corner(signs(1, 1), axis),
                 corner(signs(-1, 1), axis)});
            if (bevel <= 0.0F) continue;
            for (const float other : {-1.0F, 1.0F}) {  // edges between faces axis and u, along w
                add({corner(signs(other, -1), axis), corner(signs(other, 1), axis),
                     corner(signs(other, 1), u), corner(signs(other, -1), u)});
            }
        }
    }
    if (bevel > 0.0F) {
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 signs{(i & 1) != 0 ? 1.0F : -1.0F, (i & 2) != 0 ? 1.0F : -1.0F,
                                  (i & 4) != 0 ? 1.0F : -1.0F};
            add({corner(signs, 0), corner(signs, 1), corner(signs, 2)});
        }
    }
    return shaded(mesh, 0.1F);
}

Mesh prism(std::span<const glm::vec2> outline, float low, float high, float uvPerMetre) {
    const std::size_t count = outline.size();
    Mesh mesh;
    const auto corner = [&](std::uint32_t i, float z, float facing) {
        const glm::vec3 p{outline[i], z};
        return Vertex{p, {}, planarUv(p, {0.0F, 0.0F, facing}, uvPerMetre)};
    };
    for (const auto& t : triangulated(outline)) {
        addTriangle(mesh, corner(t[0], high, 1.0F), corner(t[1], high, 1.0F),
                    corner(t[2], high, 1.0F));
        addTriangle(mesh, corner(t[2], low, -1.0F), corner(t[1], low, -1.0F),
                    corner(t[0], low, -1.0F));
    }
    float along = 0.0F;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        bool isSlit = false;  // the outline comes back the same way
        for (std::size_t j = 0; j < count; ++j) {
            isSlit =
                isSlit || (outline[j] == outline[next] && outline[(j + 1) % count] == outline[i]);
        }
        const float length = glm::distance(outline[i], outline[next]);
        if (!isSlit) {
            const auto vertex = [&](const glm::vec3& p, float u) {
                return Vertex{p, {}, {u * uvPerMetre, -p.z * uvPerMetre}};
            };
            addQuad(mesh, vertex({outline[i], low}, along),
                    vertex({outline[next], low}, along + length),
                    vertex({outline[next], high}, along + length),
                    vertex({outline[i], high}, along));
        }
        along += length;
    }
    return shaded(mesh);
}

Mesh lathe(std::span<const glm::vec2> profile, const LatheOptions& options) {
    const std::vector<float> lengths = arcLengths(profile);
    const float repeats =
        std::max(1.0F, std::round(2.0F * pi * widest(profile) * options.uvPerMetre));
    Mesh mesh;
    addGrid(mesh, static_cast<int>(profile.size()) - 1, options.segments, true,
            [&](int row, int column) {
                const auto i = static_cast<std::size_t>(row);
                const float turn =
                    static_cast<float>(column) / static_cast<float>(options.segments);
                const float angle = turn * 2.0F * pi;
                const float radius = profile[i].x;
                const glm::vec3 position = radius == 0.0F
                                               ? glm::vec3{0.0F, profile[i].y, 0.0F}
                                               : glm::vec3{radius * std::cos(angle), profile[i].y,
                                                           -radius * std::sin(angle)};
                return Vertex{position, {}, {turn * repeats, -lengths[i] * options.uvPerMetre}};
            });
    return shaded(mesh, options.crease);
}

Mesh arc(std::span<const glm::vec2> profile, float from, float to, const LatheOptions& options) {
    std::vector<glm::vec2> loop{profile.begin(), profile.end()};
    loop.push_back(profile[0]);
    const std::vector<float> lengths = arcLengths(loop);
    const float sweep = to - from;
    const float span = sweep * widest(profile) * options.uvPerMetre;
    const auto place = [&](std::size_t i, int column) {
        const float part = static_cast<float>(column) / static_cast<float>(options.segments);
        return onCircle(loop[i].x, to - part * sweep, loop[i].y);  // counter-clockwise from above
    };
    Mesh mesh;
    addGrid(
        mesh, static_cast<int>(profile.size()), options.segments, false, [&](int row, int column) {
            const auto i = static_cast<std::size_t>(row);
            const float part = static_cast<float>(column) / static_cast<float>(options.segments);
            return Vertex{place(i, column), {}, {part * span, -lengths[i] * options.uvPerMetre}};
        });
    for (const auto& t : triangulated(profile)) {
        const auto vertex = [&](std::size_t corner, int column) {
            const std::size_t i = t[corner];
            return Vertex{
                place(i, column), {}, profile[i] * glm::vec2{1.0F, -1.0F} * options.uvPerMetre};
        };
        addTriangle(mesh, vertex(0, 0), vertex(1, 0), vertex(2, 0));
        const int last = options.segments;
        addTriangle(mesh, vertex(0, last), vertex(2, last), vertex(1, last));
    }
    return shaded(mesh, options.crease);
}

Mesh tube(std::span<const glm::vec3> path, std::span<const float> radii, int sides,
          float uvPerMetre) {
    GNOMON_EXPECTS(path.size() >= 2 && path.size() == radii.size(), "a radius for each point");
    const auto count = path.size();
    std::vector<glm::vec3> across(count);
    std::vector<glm::vec3> along(count);
    std::vector<float> lengths(count, 0.0F);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 before = path[i == 0 ? 0 : i - 1];
        const glm::vec3 after = path[std::min(i + 1, count - 1)];
        along[i] = glm::normalize(after - before);
        // Each frame is the one before, made perpendicular again: the tube does not twist.
        const glm::vec3 steep =
            std::abs(along[i].y) > 0.9F ? glm::vec3{1.0F, 0.0F, 0.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
        const glm::vec3 hint = i == 0 ? steep : across[i - 1];
        across[i] = glm::normalize(hint - glm::dot(hint, along[i]) * along[i]);
        if (i > 0) lengths[i] = lengths[i - 1] + glm::distance(path[i - 1], path[i]);
    }
    const int rows = static_cast<int>(count) + 1;
    const float repeats = std::max(1.0F, std::round(2.0F * pi * radii[0] * uvPerMetre));
    Mesh mesh;
    addGrid(mesh, rows, sides, true, [&](int row, int column) {
        // The first and the last row shrink to a point: the ends.
        const auto i = static_cast<std::size_t>(std::clamp(row - 1, 0, rows - 2));
        const float radius = row == 0 || row == rows ? 0.0F : radii[i];
        const float turn = static_cast<float>(column) / static_cast<float>(sides);
        const glm::vec3 aside = glm::cross(along[i], across[i]);
        const glm::vec3 out =
            across[i] * std::cos(turn * 2.0F * pi) + aside * std::sin(turn * 2.0F * pi);
        return Vertex{path[i] + out * radius, {}, {turn * repeats, -lengths[i] * uvPerMetre}};
    });
    return shaded(mesh, 0.9F);
}

Mesh torus(float radius, float thickness, int segments, int sides, float uvPerMetre) {
    std::vector<glm::vec2> profile;
    for (int i = 0; i < sides; ++i) {
        const float angle = 2.0F * pi * static_cast<float>(i) / static_cast<float>(sides);
        profile.emplace_back(radius + thickness * std::cos(angle), thickness * std::sin(angle));
    }
    profile.push_back(profile.front());
    return lathe(profile, {.segments = segments, .uvPerMetre = uvPerMetre, .crease = 1.2F});
}

Mesh sphere(float radius, int segments, int rings, float uvPerMetre) {
    std::vector<glm::vec2> profile{{0.0F, -radius}};
    for (int i = 1; i < rings; ++i) {
        const float angle = pi * (static_cast<float>(i) / static_cast<float>(rings) - 0.5F);
        profile.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    profile.emplace_back(0.0F, radius);
    return lathe(profile, {.segments = segments, .uvPerMetre = uvPerMetre, .crease = 1.2F});
}

std::vector<glm::vec2> rounded(std::span<const glm::vec2> profile, int steps) {
    std::vector<glm::vec2> result{profile.front()};
    for (std::size_t i = 1; i + 1 < profile.size(); ++i) {
        const glm::vec2 in = (profile[i - 1] + profile[i]) * 0.5F;
        const glm::vec2 out = (profile[i] + profile[i + 1]) * 0.5F;
        for (int k = 0; k <= steps; ++k) {  // quadratic Bezier from middle to middle
            const float t = static_cast<float>(k) / static_cast<float>(steps);
            const glm::vec2 p =
                in * (1 - t) * (1 - t) + profile[i] * 2.0F * t * (1 - t) + out * t * t;
            if (p != result.back()) result.push_back(p);
        }
    }
    if (result.back() != profile.back()) result.push_back(profile.back());
    return result;
}

}  // namespace gnomon::demo
