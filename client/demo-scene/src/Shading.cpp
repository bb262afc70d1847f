#include <gnomon/demo/Shapes.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <vector>

namespace gnomon::demo {
namespace {

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a over words
        for (const float f : {p.x, p.y, p.z}) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(f + 0.0F)) * 1099511628211ULL;
        }
        return static_cast<std::size_t>(hash ^ (hash >> 29U));
    }
};

}  // namespace

Mesh shaded(const Mesh& mesh, float crease) {
    std::unordered_map<glm::vec3, std::vector<std::uint32_t>, PositionHash> facesAt;
    facesAt.reserve(mesh.indices.size());
    std::vector<glm::vec3> areas;  // normals times twice the area: large faces count for more
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.vertices[mesh.indices[i]].position;
        const glm::vec3 b = mesh.vertices[mesh.indices[i + 1]].position;
        const glm::vec3 c = mesh.vertices[mesh.indices[i + 2]].position;
        const auto face = static_cast<std::uint32_t>(areas.size());
        areas.push_back(glm::cross(b - a, c - a));
        for (const glm::vec3& p : {a, b, c}) facesAt[p].push_back(face);
    }
    const auto direction = [&](std::size_t face) {
        const float length = glm::length(areas[face]);
        return length > 0.0F ? areas[face] / length : glm::vec3{0.0F};
    };
    const float limit = std::cos(crease);
    Mesh result;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        Vertex v = mesh.vertices[mesh.indices[i]];
        const glm::vec3 own = direction(i / 3);
        glm::vec3 sum{0.0F};
        for (const std::uint32_t face : facesAt[v.position]) {
            if (glm::dot(own, direction(face)) >= limit) sum += areas[face];
        }
        const float length = glm::length(sum);
        if (length > 0.0F) {
            v.normal = sum / length;
        } else {
            // A face without area (the closing triangle of a collinear outline) draws nothing.
            v.normal = glm::vec3{0.0F, 1.0F, 0.0F};
        }
        result.vertices.push_back(v);
        result.indices.push_back(static_cast<std::uint32_t>(i));
    }
    return welded(result);
}

}  // namespace gnomon::demo
