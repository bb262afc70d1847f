#include "gltf/Meshes.h"

#include <fmt/format.h>

#include <numeric>

#include "build/Phong.h"
#include "input/Report.h"
#include "mesh/BuildGeometry.h"

namespace gnomon::importer {
namespace {

/// More vertices than this in one primitive are refused before room is made for them.
constexpr std::size_t maxVertices = std::size_t{1} << 26U;

enum Mode : std::uint64_t { points, lines, lineLoop, lineStrip, triangles, strip, fan, modes };

/// Strips, fans and loops taken apart: @p order as the mode has it, into corners of single
/// primitives. What is left over is dropped.
std::vector<std::uint32_t> takenApart(std::vector<std::uint32_t> order, std::uint64_t mode) {
    const std::size_t n = order.size();
    std::vector<std::uint32_t> out;
    switch (mode) {
        case lines:
            order.resize(n / 2 * 2);
            return order;
        case triangles:
            order.resize(n / 3 * 3);
            return order;
        case lineLoop:
        case lineStrip:
            for (std::size_t i = 1; i < n; ++i) out.insert(out.end(), {order[i - 1], order[i]});
            if (mode == lineLoop && n > 2) out.insert(out.end(), {order[n - 1], order[0]});
            return out;
        case strip:
            // Every other triangle the other way round: all face the same side.
            for (std::size_t i = 2; i < n; ++i)
                out.insert(out.end(), {order[i - 2], order[i % 2 == 0 ? i - 1 : i],
                                       order[i % 2 == 0 ? i : i - 1]});
            return out;
        case fan:
            for (std::size_t i = 2; i < n; ++i)
                out.insert(out.end(), {order[i - 1], order[i], order[0]});
            return out;
        default:
            return order;
    }
}

template <class T, int n>
std::vector<T> readVectors(const Accessor& from, const std::vector<std::uint32_t>& used) {
    std::vector<T> out(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        std::array<float, n> value{};
        from.read(used[i], value);
        for (int c = 0; c < n; ++c) out[i][c] = value[static_cast<std::size_t>(c)];
    }
    return out;
}

std::vector<Color8> readColors(const Accessor& from, const std::vector<std::uint32_t>& used) {
    std::vector<Color8> out(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        std::array<float, 4> value{1.0F, 1.0F, 1.0F, 1.0F};
        from.read(used[i], std::span{value}.first(from.components()));
        for (std::size_t c = 0; c < 4; ++c) out[i][c] = byteOf(double{value[c]});
    }
    return out;
}

}  // namespace

const std::vector<GltfShape>& GltfMeshes::shapes(std::size_t number) {
    auto& made = made_[number];
    if (made) return *made;
    made.emplace();
    const JsonView& mesh = document_.meshes()[number];
    report_.progress(static_cast<double>(number) / static_cast<double>(made_.size()), mesh.where());
    for (const JsonView& primitive : mesh.objects("primitives"))
        if (const auto found = shape(primitive)) made->push_back(*found);
    return *made;
}

std::optional<GltfShape> GltfMeshes::shape(const JsonView& primitive) {
    const auto attributes = primitive.object("attributes");
    const auto accessorCount = document_.accessors().size();
    const auto accessor = [&](const JsonView& json, const std::string& name) {
        const auto number = json.index(name.c_str(), accessorCount, "accessors");
        return number ? *number + 1 : 0;
    };
    if (!attributes || !attributes->has("POSITION")) {
        report_.warn(primitive.where() + ": has no POSITION; left out");
        return {};
    }
    if (primitive.has("targets"))
        report_.warn("morph targets are not drawn: meshes keep their basic shape");
    if (attributes->has("JOINTS_0"))
        report_.warn("skins are not drawn: meshes stay in their bind pose");

    const GltfMaterial& material = materials_.of(primitive);
    Source source;
    source.position = accessor(*attributes, "POSITION");
    source.normal = accessor(*attributes, "NORMAL");
    if (material.textured)
        source.texCoord = accessor(*attributes, fmt::format("TEXCOORD_{}", material.texCoordSet));
    if (material.normalMap && source.texCoord != 0) {
        source.withTangents = true;
        source.tangent = accessor(*attributes, "TANGENT");
    }
    source.color = accessor(*attributes, "COLOR_0");
    source.indices = accessor(primitive, "indices");
    source.mode = primitive.unsignedInteger("mode", triangles);
    if (source.mode >= modes)
        primitive.refuse(fmt::format("mode is {}, expected 0 to 6", source.mode));
    if (primitive.extension("KHR_draco_mesh_compression") &&
        !document_.accessors()[source.position - 1].has("bufferView"))
        primitive.refuse("is compressed with Draco, which is not read");

    const auto [at, added] = geometries_.try_emplace(source, nullptr);
    if (added) at->second = geometry(source, primitive.where());
    if (at->second == nullptr) return {};
    return GltfShape{.geometry = at->second, .material = material.material};
}

std::vector<std::uint32_t> GltfMeshes::corners(const Source& source, std::size_t vertices,
                                               const std::string& where) {
    const auto countIn = [&](std::size_t count) {
        corners_ += count;
        if (corners_ > maxCorners)
            refuseForSize(
                fmt::format("{}: with it the meshes have more than {} corners", where, maxCorners));
    };
    std::vector<std::uint32_t> order;
    if (source.indices == 0) {
        countIn(vertices);
        order.resize(vertices);
        std::iota(order.begin(), order.end(), 0U);
        return order;
    }
    const Accessor accessor = accessors_.get(source.indices - 1, "indices");
    if (accessor.components() != 1 || !accessor.isUnsignedInteger())
        refuse(accessor.where() + ": expected unsigned integers of type SCALAR");
    countIn(accessor.count());
    order.resize(accessor.count());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = accessor.readIndex(i);
        if (order[i] >= vertices)
            refuse(fmt::format("{}: element {} is {}, but {} has {} vertices", accessor.where(), i,
                               order[i], where, vertices));
    }
    return order;
}

std::vector<std::uint32_t> GltfMeshes::usedVertices(std::vector<std::uint32_t>& order,
                                                    std::size_t vertices) {
    ++present_;
    if (seenBy_.size() < vertices) {
        seenBy_.resize(vertices);
        renumbered_.resize(vertices);
    }
    std::vector<std::uint32_t> used;
    for (auto& v : order) {
        if (seenBy_[v] != present_) {
            seenBy_[v] = present_;
            renumbered_[v] = static_cast<std::uint32_t>(used.size());
            used.push_back(v);
        }
        v = renumbered_[v];
    }
    return used;
}

const scene::Geometry* GltfMeshes::geometry(const Source& source, const std::string& where) {
    const Accessor position = accessors_.get(source.position - 1, "POSITION");
    if (position.components() != 3) refuse(position.where() + ": expected type VEC3");
    const std::size_t vertices = position.count();
    if (vertices > maxVertices)
        refuseForSize(fmt::format("{}: {} vertices in one primitive, the limit is {}",
                                  position.where(), vertices, maxVertices));
    const auto attribute = [&](std::size_t number, const char* use, std::size_t least,
                               std::size_t most) {
        Accessor accessor = accessors_.get(number - 1, use);
        if (accessor.count() != vertices)
            refuse(fmt::format("{}: {} elements, but {} has {}", accessor.where(), accessor.count(),
                               position.where(), vertices));
        if (accessor.components() < least || accessor.components() > most)
            refuse(fmt::format("{}: {} components, expected type VEC{}", accessor.where(),
                               accessor.components(), least));
        return accessor;
    };
    MeshData mesh;
    // Attributes are checked before indices are read: a count that lies is told as such.
    std::optional<Accessor> normal, texCoord, tangent, color;
    if (source.normal != 0) normal = attribute(source.normal, "NORMAL", 3, 3);
    if (source.texCoord != 0) texCoord = attribute(source.texCoord, "TEXCOORD", 2, 2);
    if (source.tangent != 0) tangent = attribute(source.tangent, "TANGENT", 4, 4);
    if (source.color != 0) color = attribute(source.color, "COLOR_0", 3, 4);

    auto order = corners(source, vertices, where);
    const auto used = usedVertices(order, vertices);
    mesh.indices = takenApart(std::move(order), source.mode);
    if (mesh.indices.empty()) return nullptr;
    mesh.primitive = source.mode == points      ? scene::Primitive::points
                     : source.mode <= lineStrip ? scene::Primitive::lines
                                                : scene::Primitive::triangles;
    mesh.positions = readVectors<math::vec3, 3>(position, used);
    if (normal) mesh.normals = readVectors<math::vec3, 3>(*normal, used);
    if (texCoord) mesh.texCoords = readVectors<math::vec2, 2>(*texCoord, used);
    if (tangent) mesh.tangents = readVectors<math::vec4, 4>(*tangent, used);
    if (color) mesh.colors = readColors(*color, used);
    return buildGeometry(aspect_, std::move(mesh), source.withTangents, report_, where);
}

}  // namespace gnomon::importer
