#pragma once

#include <gnomon/scene/Geometry.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "gltf/Accessors.h"
#include "gltf/Materials.h"
#include "mesh/MeshData.h"

namespace gnomon::importer {

/// One primitive of a mesh, ready to be put under any number of nodes.
struct GltfShape {
    const scene::Geometry* geometry = nullptr;
    const scene::Material* material = nullptr;
};

/// Makes Geometries of a file's meshes, each when first asked for. Primitives that read the same
/// accessors in the same way share one.
class GltfMeshes {
public:
    /// The most corners of all different primitives of a file: 50 million triangles.
    static constexpr std::uint64_t maxCorners = 150'000'000;

    GltfMeshes(const GltfDocument& document, Accessors& accessors, GltfMaterials& materials,
               field::Aspect& aspect, Report& report)
        : document_{document},
          accessors_{accessors},
          materials_{materials},
          aspect_{aspect},
          report_{report},
          made_(document.meshes().size()) {}

    /// What is drawn for mesh @p number, which exists.
    const std::vector<GltfShape>& shapes(std::size_t number);

private:
    /// What a primitive reads: accessor numbers + 1, 0 for none.
    struct Source {
        std::size_t position = 0, normal = 0, texCoord = 0, tangent = 0, color = 0, indices = 0;
        std::uint64_t mode = 4;
        bool withTangents = false;
        friend auto operator<=>(const Source&, const Source&) = default;
    };

    std::optional<GltfShape> shape(const JsonView& primitive);
    const scene::Geometry* geometry(const Source& source, const std::string& where);
    std::vector<std::uint32_t> corners(const Source& source, std::size_t vertices,
                                       const std::string& where);
    std::vector<std::uint32_t> usedVertices(std::vector<std::uint32_t>& corners,
                                            std::size_t vertices);

    const GltfDocument& document_;
    Accessors& accessors_;
    GltfMaterials& materials_;
    field::Aspect& aspect_;
    Report& report_;
    std::vector<std::optional<std::vector<GltfShape>>> made_;
    std::map<Source, const scene::Geometry*> geometries_;
    std::uint64_t corners_ = 0;
    // Which vertices the present primitive uses: seenBy_[v] == present_ means yes, as
    // renumbered_[v].
    std::vector<std::uint32_t> seenBy_, renumbered_;
    std::uint32_t present_ = 0;
};

}  // namespace gnomon::importer
