#pragma once

#include <gnomon/scene/Material.h>

#include <map>
#include <string>

#include "image/Textures.h"
#include "input/Files.h"
#include "obj/Mtl.h"

namespace gnomon::importer {

/// Makes PhongMaterials of .mtl materials, each once.
class ObjMaterials {
public:
    ObjMaterials(field::Aspect& aspect, Folder& folder, Report& report)
        : aspect_{aspect}, folder_{folder}, report_{report}, textures_{aspect, report} {}

    /// Reads an .mtl file; a warning where it cannot be read.
    void addLibrary(const std::string& name);
    const scene::PhongMaterial& get(const std::string& name);
    /// The default material with a texture of its own.
    const scene::PhongMaterial& textured(const std::string& image);

private:
    ImageSource source(const std::string& file);
    std::optional<Image> load(const std::string& file);
    void setDiffuse(const MtlMaterial& from, scene::PhongMaterial& to);
    void setNormals(const MtlMaterial& from, scene::PhongMaterial& to);

    field::Aspect& aspect_;
    Folder& folder_;
    Report& report_;
    Textures textures_;
    MtlLibrary library_;
    std::map<std::string, const scene::PhongMaterial*> made_;
};

}  // namespace gnomon::importer
