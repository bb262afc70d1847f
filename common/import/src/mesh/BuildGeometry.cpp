#include "mesh/BuildGeometry.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "input/Files.h"
#include "mesh/Chunks.h"
#include "mesh/FlatIndex.h"
#include "mesh/Normals.h"
#include "mesh/Tangents.h"
#include "mesh/Topology.h"

namespace gnomon::importer {
namespace {

bool usable(const math::vec3& p) noexcept {
    // Comparisons with NaN are false.
    return std::abs(p.x) <= largestCoordinate && std::abs(p.y) <= largestCoordinate &&
           std::abs(p.z) <= largestCoordinate;
}

void dropUnusable(MeshData& mesh, Report& report, std::string_view where) {
    std::vector<bool> good(mesh.positions.size());
    bool allGood = true;
    for (std::size_t i = 0; i < good.size(); ++i) {
        good[i] = usable(mesh.positions[i]);
        allGood = allGood && good[i];
    }
    if (allGood) return;
    const std::size_t corners = cornersOf(mesh.primitive);
    std::size_t kept = 0;
    const std::size_t count = mesh.indices.size() / corners;
    for (std::size_t i = 0; i < count; ++i) {
        bool whole = true;
        for (std::size_t k = 0; k < corners; ++k)
            whole = whole && good[mesh.indices[i * corners + k]];
        if (!whole) continue;
        for (std::size_t k = 0; k < corners; ++k)
            mesh.indices[kept * corners + k] = mesh.indices[i * corners + k];
        ++kept;
    }
    mesh.indices.resize(kept * corners);
    if (kept < count)
        report.warn(
            fmt::format("{}: {} of {} {} dropped: positions that are not finite or beyond {:g}",
                        where, count - kept, count,
                        corners == 3   ? "triangles"
                        : corners == 2 ? "lines"
                                       : "points",
                        largestCoordinate));
    // What no primitive uses still gets compared and hashed.
    for (std::size_t i = 0; i < good.size(); ++i)
        if (!good[i]) mesh.positions[i] = math::vec3{0.0F};
}

void repairTexCoords(MeshData& mesh) {
    for (auto& t : mesh.texCoords)
        if (!std::isfinite(t.x) || !std::isfinite(t.y)) t = math::vec2{0.0F};
}

/// Lets every index of equal vertices be that of the first of them.
void shareEqualVertices(MeshData& mesh) {
    const auto equal = [&](std::uint32_t a, std::uint32_t b) {
        return mesh.positions[a] == mesh.positions[b] &&
               (mesh.normals.empty() || mesh.normals[a] == mesh.normals[b]) &&
               (mesh.texCoords.empty() || mesh.texCoords[a] == mesh.texCoords[b]) &&
               (mesh.tangents.empty() || mesh.tangents[a] == mesh.tangents[b]) &&
               (mesh.colors.empty() || mesh.colors[a] == mesh.colors[b]);
    };
    FlatIndex index{mesh.positions.size()};
    std::vector<std::uint32_t> first(mesh.positions.size());
    for (std::uint32_t v = 0; v < first.size(); ++v) {
        WordHash hash;
        hash.addObject(mesh.positions[v] + math::vec3{0.0F});  // -0 + 0 is 0
        if (!mesh.normals.empty()) hash.addObject(mesh.normals[v] + math::vec3{0.0F});
        if (!mesh.texCoords.empty()) hash.addObject(mesh.texCoords[v] + math::vec2{0.0F});
        if (!mesh.tangents.empty()) hash.addObject(mesh.tangents[v] + math::vec4{0.0F});
        if (!mesh.colors.empty()) hash.addObject(mesh.colors[v]);
        first[v] =
            index.findOrAdd(hash.value(), v, [&](std::uint32_t other) { return equal(other, v); });
    }
    for (auto& i : mesh.indices) i = first[i];
}

/// Numbers vertices in the order the indices first use them; unused ones are left out.
void orderVertices(MeshData& mesh) {
    constexpr std::uint32_t unseen = 0xffffffffU;
    std::vector<std::uint32_t> renumbered(mesh.positions.size(), unseen);
    std::vector<std::uint32_t> order;
    for (auto& i : mesh.indices) {
        if (renumbered[i] == unseen) {
            renumbered[i] = static_cast<std::uint32_t>(order.size());
            order.push_back(i);
        }
        i = renumbered[i];
    }
    const auto apply = [&](auto& values) {
        if (values.empty()) return;
        std::remove_reference_t<decltype(values)> out;
        out.reserve(order.size());
        for (const auto v : order) out.push_back(values[v]);
        values = std::move(out);
    };
    apply(mesh.positions);
    apply(mesh.normals);
    apply(mesh.texCoords);
    apply(mesh.tangents);
    apply(mesh.colors);
}

template <class T>
field::Payload payloadOf(const std::vector<T>& values) {
    // Payload::of asks for trivially copyable items; GLM's are not in name, but plain floats in
    // fact.
    const auto* raw = reinterpret_cast<const std::byte*>(values.data());
    if (values.empty()) return {};
    return field::Payload{Bytes(raw, raw + values.size() * sizeof(T))};
}

}  // namespace

const scene::Geometry* buildGeometry(field::Aspect& aspect, MeshData mesh, bool withTangents,
                                     Report& report, std::string_view where) {
    const bool triangles = mesh.primitive == scene::Primitive::triangles;
    dropUnusable(mesh, report, where);
    if (mesh.indices.empty()) return nullptr;
    repairNormals(mesh);
    repairTexCoords(mesh);
    if (!withTangents || !triangles || mesh.texCoords.empty()) {
        mesh.tangents.clear();
    } else {
        if (mesh.normals.empty()) {
            // Flat shading, but a normal map needs a normal at each corner.
            mesh.tangents.clear();
            unshareVertices(mesh);
            addFlatNormals(mesh);
        }
        if (mesh.tangents.empty())
            addTangents(mesh);
        else
            repairTangents(mesh);
    }
    shareEqualVertices(mesh);
    orderVertices(mesh);

    std::vector<bool> closed;
    if (triangles) {
        const auto welded = weldedPositions(mesh.positions);
        std::vector<std::uint32_t> corners(mesh.indices.size());
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = welded[mesh.indices[i]];
        closed = closedTriangles(corners, mesh.positions.size());
    }
    auto chunks = cutIntoChunks(mesh.positions, mesh.indices, cornersOf(mesh.primitive), closed);
    orderVertices(mesh);

    const auto& geometry = aspect.create<scene::Geometry>();
    auto e = scene::edit(geometry);
    e->primitive = mesh.primitive;
    e->positions = payloadOf(mesh.positions);
    e->normals = payloadOf(mesh.normals);
    e->texCoords = payloadOf(mesh.texCoords);
    e->tangents = payloadOf(mesh.tangents);
    e->colors = payloadOf(mesh.colors);
    e->indices = payloadOf(mesh.indices);
    math::vec3 min = chunks.front().min;
    math::vec3 max = chunks.front().max;
    for (const auto& chunk : chunks) {
        min = glm::min(min, chunk.min);
        max = glm::max(max, chunk.max);
    }
    e->boundsMin = min;
    e->boundsMax = max;
    e->chunks.assign(std::move(chunks));
    return &geometry;
}

}  // namespace gnomon::importer
