// Wavefront Technologies. Object Files (.obj), Advanced Visualizer Manual, Appendix B1; polygons,
// lines and points of it. Smoothing groups are not used: normals are the file's or creased at 60
// degrees.
#include "obj/Obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "mesh/BuildGeometry.h"
#include "mesh/Normals.h"
#include "obj/ObjFile.h"
#include "obj/ObjMaterials.h"

namespace gnomon::importer {
namespace {

bool lacksNormals(const ObjPart& part) {
    return std::any_of(part.triangles.begin(), part.triangles.end(),
                       [](const ObjCorner& c) { return c.normal == ObjCorner::none; });
}

/// Normals for each corner of the parts that have none, in their order; faces of all parts round
/// off one another.
std::vector<math::vec3> smoothNormals(const ObjFile& file) {
    if (std::none_of(file.parts.begin(), file.parts.end(), lacksNormals)) return {};
    std::vector<std::uint32_t> corners;
    for (const ObjPart& part : file.parts)
        for (const auto& corner : part.triangles) corners.push_back(corner.position);
    return creasedNormals(file.positions, corners);
}

MeshData meshOf(const ObjFile& file, std::span<const ObjCorner> corners,
                scene::Primitive primitive) {
    MeshData mesh{.primitive = primitive};
    mesh.indices.resize(corners.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    const bool textured = std::any_of(corners.begin(), corners.end(), [](const ObjCorner& c) {
        return c.texCoord != ObjCorner::none;
    });
    for (const auto& c : corners) {
        mesh.positions.push_back(file.positions[c.position]);
        if (!file.colors.empty()) mesh.colors.push_back(file.colors[c.position]);
        if (textured)
            mesh.texCoords.push_back(c.texCoord == ObjCorner::none ? math::vec2{0.0F}
                                                                   : file.texCoords[c.texCoord]);
    }
    return mesh;
}

}  // namespace

void readObj(std::span<const std::byte> bytes, Folder& folder, SceneBuilder& to) {
    ObjFile file = parsedObj(asText(bytes), to.report());
    to.useLevels(2);
    ObjMaterials materials{to.aspect(), folder, to.report()};
    for (const auto& library : file.libraries) materials.addLibrary(library);

    const auto smooth = smoothNormals(file);
    std::size_t first = 0;  // of the part's corners among all
    for (std::size_t i = 0; i < file.parts.size(); ++i) {
        ObjPart& part = file.parts[i];
        to.report().progress(
            0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(file.parts.size()),
            "building");
        const auto name = part.name.empty() ? fmt::format("part {}", i) : part.name;
        const auto& material = materials.get(part.material);
        const auto add = [&](MeshData mesh) {
            if (const auto* geometry = buildGeometry(to.aspect(), std::move(mesh),
                                                     static_cast<bool>(*material.normalMap),
                                                     to.report(), "\"" + printable(name) + "\""))
                to.addShape(to.content(), name, *geometry, material, math::dmat4{1.0});
        };
        MeshData mesh = meshOf(file, part.triangles, scene::Primitive::triangles);
        const bool computed = lacksNormals(part);
        for (std::size_t k = 0; k < part.triangles.size(); ++k)
            mesh.normals.push_back(computed ? smooth[first + k]
                                            : file.normals[part.triangles[k].normal]);
        first += part.triangles.size();
        add(std::move(mesh));
        if (!part.lines.empty()) add(meshOf(file, part.lines, scene::Primitive::lines));
        if (!part.points.empty()) add(meshOf(file, part.points, scene::Primitive::points));
        part = {};  // its memory is needed for what comes
    }
}

}  // namespace gnomon::importer
