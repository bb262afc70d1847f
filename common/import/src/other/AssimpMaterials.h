#pragma once

#include <assimp/scene.h>
#include <gnomon/scene/Material.h>

#include <vector>

#include "image/Textures.h"
#include "input/Files.h"

namespace gnomon::importer {

/// Makes PhongMaterials of Assimp's, each once.
class AssimpMaterials {
public:
    AssimpMaterials(const aiScene& scene, field::Aspect& aspect, Folder& folder, Report& report)
        : scene_{scene},
          aspect_{aspect},
          folder_{folder},
          textures_{aspect, report},
          made_(scene.mNumMaterials) {}

    /// The default one for a number there is not.
    const scene::PhongMaterial& get(unsigned number);

private:
    const scene::Texture* texture(const aiMaterial& material, aiTextureType type, bool srgb);
    void read(const aiMaterial& from, scene::PhongMaterial& to);

    const aiScene& scene_;
    field::Aspect& aspect_;
    Folder& folder_;
    Textures textures_;
    std::vector<const scene::PhongMaterial*> made_;
    const scene::PhongMaterial* default_ = nullptr;
};

}  // namespace gnomon::importer
