#include "mesh/Tangents.h"

#include <cmath>

#include "mesh/Normals.h"

namespace gnomon::importer {
namespace {

math::vec3 anyOrthogonal(const math::vec3& n) noexcept {
    const math::vec3 axis =
        std::abs(n.x) < 0.9F ? math::vec3{1.0F, 0.0F, 0.0F} : math::vec3{0.0F, 1.0F, 0.0F};
    return glm::normalize(glm::cross(axis, n));
}

struct FaceTangent {
    math::dvec3 direction{0.0};
    bool mirrored = false;
};

FaceTangent faceTangent(const MeshData& mesh, const std::uint32_t* c) {
    const math::dvec3 p0{mesh.positions[c[0]]};
    const math::dvec3 e1 = math::dvec3{mesh.positions[c[1]]} - p0;
    const math::dvec3 e2 = math::dvec3{mesh.positions[c[2]]} - p0;
    const math::dvec2 t0{mesh.texCoords[c[0]]};
    const math::dvec2 d1 = math::dvec2{mesh.texCoords[c[1]]} - t0;
    const math::dvec2 d2 = math::dvec2{mesh.texCoords[c[2]]} - t0;
    const double determinant = d1.x * d2.y - d2.x * d1.y;
    // v grows downwards in the image, and a normal map's +y is up: the sign of the handedness is
    // the opposite of that of the determinant.
    FaceTangent tangent{.mirrored = determinant > 0.0};
    if (determinant == 0.0) return tangent;  // texture coordinates without area: no direction
    tangent.direction = (e1 * d2.y - e2 * d1.y) * (determinant > 0.0 ? 1.0 : -1.0);
    return tangent;
}

/// A copy of vertex @p v at the end; its number.
std::uint32_t duplicateVertex(MeshData& mesh, std::uint32_t v) {
    const auto copyIn = [v](auto& values) {
        if (values.empty()) return;
        const auto value = values[v];  // before push_back moves the array
        values.push_back(value);
    };
    copyIn(mesh.positions);
    copyIn(mesh.normals);
    copyIn(mesh.texCoords);
    copyIn(mesh.colors);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

}  // namespace

void addTangents(MeshData& mesh) {
    constexpr std::uint32_t none = 0xffffffffU;
    enum : std::uint8_t { unused, plain, mirrored };
    std::vector<std::uint8_t> kind(mesh.positions.size(), unused);
    std::vector<std::uint32_t> twin(mesh.positions.size(), none);
    std::vector<math::dvec3> sums(mesh.positions.size());
    mesh.tangents.clear();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const FaceTangent face = faceTangent(mesh, &mesh.indices[i]);
        const auto wanted = face.mirrored ? mirrored : plain;
        for (std::size_t k = 0; k < 3; ++k) {
            auto v = mesh.indices[i + k];
            if (kind[v] == unused) kind[v] = wanted;
            if (kind[v] != wanted) {
                if (twin[v] == none) {
                    twin[v] = duplicateVertex(mesh, v);
                    kind.push_back(wanted);
                    twin.push_back(v);
                    sums.emplace_back(0.0);
                }
                v = mesh.indices[i + k] = twin[v];
            }
            sums[v] += face.direction;
        }
    }
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.tangents.size(); ++v) {
        const math::dvec3 n{mesh.normals[v]};
        const auto direction = unitOr(sums[v], math::vec3{0.0F});
        const math::dvec3 d{direction};
        const auto tangent = unitOr(d - n * glm::dot(n, d), anyOrthogonal(mesh.normals[v]));
        mesh.tangents[v] = math::vec4{tangent, kind[v] == mirrored ? -1.0F : 1.0F};
    }
}

void repairTangents(MeshData& mesh) {
    for (std::size_t v = 0; v < mesh.tangents.size(); ++v) {
        auto& t = mesh.tangents[v];
        const auto other =
            mesh.normals.empty() ? math::vec3{1.0F, 0.0F, 0.0F} : anyOrthogonal(mesh.normals[v]);
        const auto direction = unitOr(math::dvec3{t.x, t.y, t.z}, other);
        t = math::vec4{direction, t.w < 0.0F ? -1.0F : 1.0F};
    }
}

}  // namespace gnomon::importer
