#pragma once

#include <gnomon/scene/Material.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gltf/Document.h"
#include "image/Textures.h"

namespace gnomon::importer {

/// A material, and what it wants of the meshes it is put on.
struct GltfMaterial {
    const scene::PhongMaterial* material = nullptr;
    std::uint32_t texCoordSet = 0;
    bool textured = false;
    bool normalMap = false;
};

/// Makes PhongMaterials of a file's materials, each once, when first asked for.
class GltfMaterials {
public:
    GltfMaterials(const GltfDocument& document, field::Aspect& aspect, Report& report);

    /// @param primitive  names its material, or has none and gets the default one
    const GltfMaterial& of(const JsonView& primitive);

private:
    /// Where a textureInfo looks in its texture: set and transform.
    struct Mapping {
        std::uint32_t set = 0;
        math::vec3 rowS{1.0F, 0.0F, 0.0F};
        math::vec3 rowT{0.0F, 1.0F, 0.0F};
        friend bool operator==(const Mapping&, const Mapping&) = default;
    };
    struct Image {
        std::string name = {};
        ImageSource source = {};
    };
    struct Slot {
        const scene::Texture* texture = nullptr;
        Mapping mapping = {};
    };

    GltfMaterial make(const JsonView& json);
    void readSurface(const JsonView& json, scene::PhongMaterial& to);
    std::optional<Slot> slot(const JsonView& parent, const char* key, bool srgb);
    static Mapping mapping(const JsonView& info);
    std::optional<std::size_t> imageOf(const JsonView& info) const;
    Image image(std::size_t number) const;
    Sampler sampler(const JsonView& texture) const;

    const GltfDocument& document_;
    field::Aspect& aspect_;
    Report& report_;
    Textures textures_;
    std::vector<JsonView> json_, texturesJson_, imagesJson_, samplersJson_;
    std::vector<std::optional<GltfMaterial>> made_;
    std::optional<GltfMaterial> default_;
};

}  // namespace gnomon::importer
