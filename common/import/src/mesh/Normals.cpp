#include "mesh/Normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/Topology.h"

namespace gnomon::importer {
namespace {

constexpr math::vec3 anyNormal{0.0F, 0.0F, 1.0F};

/// More faces than this around one place (the tip of a cone with 10,000 sides; a hostile file) are
/// not compared with one another: that would be quadratic.
constexpr std::size_t maxFacesCompared = 256;

template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    std::vector<T> out;
    if (values.empty()) return out;
    out.reserve(indices.size());
    for (const auto i : indices) out.push_back(values[i]);
    return out;
}

}  // namespace

math::dvec3 areaNormal(const math::vec3& a, const math::vec3& b, const math::vec3& c) noexcept {
    const math::dvec3 origin{a};
    return glm::cross(math::dvec3{b} - origin, math::dvec3{c} - origin);
}

math::vec3 unitOr(const math::dvec3& v, const math::vec3& otherwise) noexcept {
    // Scaled first, so that neither tiny nor huge vectors under- or overflow when squared.
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return otherwise;
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0)) return otherwise;
    return math::vec3{glm::normalize(v / largest)};
}

std::vector<math::vec3> creasedNormals(std::span<const math::vec3> positions,
                                       std::span<const std::uint32_t> corners) {
    const auto welded = weldedPositions(positions);
    const std::size_t triangles = corners.size() / 3;
    std::vector<math::dvec3> area(triangles);
    std::vector<math::vec3> unit(triangles);
    std::vector<std::uint32_t> place(corners.size());
    for (std::size_t t = 0; t < triangles; ++t) {
        const auto* c = &corners[t * 3];
        area[t] = areaNormal(positions[c[0]], positions[c[1]], positions[c[2]]);
        unit[t] = unitOr(area[t], math::vec3{0.0F});
        if (unit[t] == math::vec3{0.0F}) area[t] = math::dvec3{0.0};  // might be NaN
        for (std::size_t k = 0; k < 3; ++k) place[t * 3 + k] = welded[c[k]];
    }
    const Buckets around = sortedIntoBuckets(place, positions.size());

    std::vector<math::vec3> normals(corners.size());
    for (std::uint32_t p = 0; p < positions.size(); ++p) {
        const auto fan = around.of(p);
        if (fan.empty()) continue;
        math::dvec3 all{0.0};
        for (const auto corner : fan) all += area[corner / 3];
        const math::vec3 mean = unitOr(all, anyNormal);
        for (const auto corner : fan) {
            const math::vec3 own = unit[corner / 3];
            const bool flat = own == math::vec3{0.0F};
            if (flat || fan.size() > maxFacesCompared) {
                normals[corner] = flat || glm::dot(own, mean) >= creaseCosine ? mean : own;
                continue;
            }
            math::dvec3 sum{0.0};
            for (const auto other : fan)
                if (glm::dot(own, unit[other / 3]) >= creaseCosine) sum += area[other / 3];
            normals[corner] = unitOr(sum, own);
        }
    }
    return normals;
}

void unshareVertices(MeshData& mesh) {
    mesh.positions = gathered(mesh.positions, mesh.indices);
    mesh.normals = gathered(mesh.normals, mesh.indices);
    mesh.texCoords = gathered(mesh.texCoords, mesh.indices);
    mesh.tangents = gathered(mesh.tangents, mesh.indices);
    mesh.colors = gathered(mesh.colors, mesh.indices);
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
}

void addFlatNormals(MeshData& mesh) {
    mesh.normals.assign(mesh.positions.size(), anyNormal);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto* c = &mesh.indices[i];
        const auto normal =
            unitOr(areaNormal(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]),
                   anyNormal);
        for (std::size_t k = 0; k < 3; ++k) mesh.normals[c[k]] = normal;
    }
}

void repairNormals(MeshData& mesh) {
    bool broken = false;
    for (auto& normal : mesh.normals) {
        normal = unitOr(math::dvec3{normal}, math::vec3{0.0F});
        broken = broken || normal == math::vec3{0.0F};
    }
    if (!broken) return;
    std::vector<math::dvec3> sums(mesh.positions.size());
    if (mesh.primitive == scene::Primitive::triangles) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto* c = &mesh.indices[i];
            const auto normal =
                areaNormal(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]);
            for (std::size_t k = 0; k < 3; ++k) sums[c[k]] += normal;
        }
    }
    for (std::size_t v = 0; v < mesh.normals.size(); ++v)
        if (mesh.normals[v] == math::vec3{0.0F}) mesh.normals[v] = unitOr(sums[v], anyNormal);
}

}  // namespace gnomon::importer
