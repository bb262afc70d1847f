#include <gnomon/base/Error.h>
#include <gnomon/demo/Mesh.h>

#include <bit>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <unordered_map>

#include "Polygon.h"

namespace gnomon::demo {
namespace {

struct VertexHash {
    std::size_t operator()(const Vertex& v) const {
        std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a over words
        for (const float f : {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y,
                              v.normal.z, v.uv.x, v.uv.y}) {
            // Adding 0 turns -0 into +0, which compares equal and so must hash equal.
            hash = (hash ^ std::bit_cast<std::uint32_t>(f + 0.0F)) * 1099511628211ULL;
        }
        return static_cast<std::size_t>(hash ^ (hash >> 29U));
    }
};

}  // namespace

void addTriangle(Mesh& mesh, const Vertex& a, const Vertex& b, const Vertex& c) {
    if (a.position == b.position || b.position == c.position || c.position == a.position) return;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
}

void addQuad(Mesh& mesh, const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
    addTriangle(mesh, a, b, c);
    addTriangle(mesh, a, c, d);
}

glm::vec2 planarUv(const glm::vec3& position, const glm::vec3& normal, float uvPerMetre) {
    // For floors, "up" is away from a viewer who looks along -Z.
    const bool flat = std::abs(normal.y) > 0.9F;
    const glm::vec3 hint = flat ? glm::vec3{0.0F, 0.0F, -1.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
    const glm::vec3 right = glm::normalize(glm::cross(hint, normal));
    const glm::vec3 up = glm::cross(normal, right);
    return {glm::dot(position, right) * uvPerMetre, -glm::dot(position, up) * uvPerMetre};
}

void addPolygon(Mesh& mesh, std::span<const glm::vec3> corners, float uvPerMetre) {
    GNOMON_EXPECTS(corners.size() >= 3, "a polygon has three corners");
    glm::vec3 area{0.0F};  // Newell's normal: right for concave outlines too
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::vec3 a = corners[i] - corners[0];
        const glm::vec3 b = corners[(i + 1) % corners.size()] - corners[0];
        area += glm::cross(a, b);
    }
    const glm::vec3 normal = glm::normalize(area);
    const glm::vec3 axis =
        std::abs(normal.y) > 0.9F ? glm::vec3{1.0F, 0.0F, 0.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
    const glm::vec3 across = glm::normalize(glm::cross(axis, normal));
    const glm::vec3 along = glm::cross(normal, across);
    std::vector<glm::vec2> outline;
    for (const glm::vec3& p : corners) {
        outline.emplace_back(glm::dot(p - corners[0], across), glm::dot(p - corners[0], along));
    }
    const auto vertex = [&](std::uint32_t i) {
        return Vertex{corners[i], normal, planarUv(corners[i], normal, uvPerMetre)};
    };
    for (const auto& t : triangulated(outline)) {
        addTriangle(mesh, vertex(t[0]), vertex(t[1]), vertex(t[2]));
    }
}

void append(Mesh& mesh, const Mesh& part, const glm::mat4& meshFromPart) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const glm::mat3 linear{meshFromPart};
    const glm::mat3 normals = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0.0F;
    for (const Vertex& v : part.vertices) {
        mesh.vertices.push_back({.position = glm::vec3{meshFromPart * glm::vec4{v.position, 1.0F}},
                                 .normal = glm::normalize(normals * v.normal),
                                 .uv = v.uv});
    }
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        mesh.indices.push_back(first + part.indices[i]);
        mesh.indices.push_back(first + part.indices[mirrored ? i + 2 : i + 1]);
        mesh.indices.push_back(first + part.indices[mirrored ? i + 1 : i + 2]);
    }
}

Mesh welded(const Mesh& mesh) {
    Mesh result;
    std::unordered_map<Vertex, std::uint32_t, VertexHash> known;
    known.reserve(mesh.vertices.size());
    for (const std::uint32_t index : mesh.indices) {
        const Vertex& v = mesh.vertices[index];
        const auto [at, isNew] =
            known.try_emplace(v, static_cast<std::uint32_t>(result.vertices.size()));
        if (isNew) result.vertices.push_back(v);
        result.indices.push_back(at->second);
    }
    return result;
}

}  // namespace gnomon::demo
