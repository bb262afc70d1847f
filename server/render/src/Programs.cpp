#include "Programs.h"

#include <gnomon/gl/Shader.h>
#include <gnomon/shadow/Filter.h>

#include <array>
#include <vector>

#include "Glsl.h"
#include "MeshStore.h"

namespace gnomon::render {
namespace {

std::string definesFor(const Variant& v) {
    std::string text;
    const auto define = [&](bool on, const char* name) {
        if (on) text += std::string{"#define "} + name + "\n";
    };
    define((v.format & hasNormals) != 0, "HAS_NORMALS");
    define((v.format & hasTexCoords) != 0, "HAS_TEXCOORDS");
    define((v.format & hasTangents) != 0, "HAS_TANGENTS");
    define((v.format & hasColors) != 0, "HAS_COLORS");
    define((v.features & Variant::diffuseMap) != 0, "DIFFUSE_MAP");
    define((v.features & Variant::normalMap) != 0, "NORMAL_MAP");
    define((v.features & Variant::emissiveMap) != 0, "EMISSIVE_MAP");
    define((v.features & Variant::alphaMask) != 0, "ALPHA_MASK");
    define((v.features & Variant::unlit) != 0, "UNLIT");
    define((v.features & Variant::scopedLights) != 0, "SCOPED_LIGHTS");
    define((v.features & Variant::shadows) != 0, "SHADOWS");
    define((v.features & Variant::pagedMaps) != 0, "PAGED_MAPS");
    define((v.features & Variant::perspectiveMaps) != 0, "PERSPECTIVE_MAPS");
    define((v.features & Variant::factorImages) != 0, "FACTOR_IMAGES");
    define(v.pass == Variant::Pass::depth, "DEPTH_ONLY");
    const auto calls = [&](const char* list, const char* call, int first, int count) {
        text += std::string{"#define "} + list;
        for (int i = first; i < first + count; ++i)
            text += std::string{" "} + call + "(" + std::to_string(i) +
                    (i < v.places ? ", INTERPOLATED)" : ", FOUND)");
        text += "\n";
    };
    calls("DIRECTIONAL_LIGHTS", "DIRECTIONAL", 0, v.directionalLights);
    calls("OTHER_LIGHTS", "OTHER", v.directionalLights, v.otherLights);
    if ((v.features & Variant::manyLights) != 0)
        text += "#define MANY_LIGHTS " + std::to_string(v.directionalLights + v.otherLights) + "\n";
    if (v.lightCount > 0) {
        calls("UNBLURRED_LIGHTS", "UNBLURRED", v.firstLight, v.lightCount);
        text += "#define FIRST_LIGHT " + std::to_string(v.firstLight) + "\n";
        text += "#define LIGHT_COUNT " + std::to_string(v.lightCount) + "\n";
    }
    text += "#define MAPS_PER_LIGHT " + std::to_string(v.mapsPerLight) + "\n";
    text += "#define SHADOW_LIGHTS " + std::to_string(v.shadowLights) + "\n";
    text += "#define SHADOW_PLACES " + std::to_string(v.places) + "\n";
    return text;
}

}  // namespace

gl::Program Programs::build(std::string_view label, std::string_view defines,
                            std::initializer_list<std::string_view> vertex,
                            std::initializer_list<std::string_view> fragment) const {
    std::vector<gl::ShaderStage> stages;
    const auto add = [&](GLenum type, std::initializer_list<std::string_view> parts) {
        if (parts.size() == 0) return;
        gl::ShaderStage stage{.type = type, .parts = {glsl::version(), defines}};
        stage.parts.insert(stage.parts.end(), parts.begin(), parts.end());
        stages.push_back(std::move(stage));
    };
    add(GL_VERTEX_SHADER, vertex);
    add(GL_FRAGMENT_SHADER, fragment);
    return orThrow(gl::buildProgram(gl_, label, stages));
}

void Programs::useFilter(std::string_view name) {
    if (name == filter_ || shadow::findFilter(name) == nullptr) return;
    filter_ = name;
    std::erase_if(meshes_,
                  [](const auto& entry) { return (entry.first.features & Variant::shadows) != 0; });
    std::erase_if(combine_, [](const auto& entry) { return std::get<0>(entry.first) > 0; });
}

GLuint Programs::mesh(const Variant& variant) {
    const auto [at, isNew] = meshes_.try_emplace(variant);
    if (!isNew) return at->second.id();
    const std::string defines = definesFor(variant);
    const bool shadows = (variant.features & Variant::shadows) != 0;
    const bool images = (variant.features & Variant::factorImages) != 0;
    const bool mapped = shadows && !images;
    const std::string_view maps = mapped ? shadow::mapsGlsl() : "";
    const std::string_view lookup = images   ? glsl::factorLookup()
                                    : mapped ? shadow::lookupGlsl()
                                             : "";
    const std::string_view shared = mapped ? shadow::findFilter(filter_)->shared : "";
    const std::string_view filter = mapped ? shadow::findFilter(filter_)->glsl : "";
    switch (variant.pass) {
        case Variant::Pass::color:
            at->second = build("surface", defines, {maps, glsl::meshVertex()},
                               {glsl::meshCommon(), maps, lookup, shared, filter,
                                glsl::meshPlaces(), glsl::meshColor()});
            break;
        case Variant::Pass::factor:
            at->second = build("shadow factor", defines, {maps, glsl::meshVertex()},
                               {glsl::meshCommon(), maps, lookup, shared, filter,
                                glsl::meshPlaces(), glsl::meshFactor()});
            break;
        case Variant::Pass::unblurred:
            at->second = build("unblurred factors", defines, {maps, glsl::meshVertex()},
                               {glsl::meshCommon(), maps, lookup, shared, filter,
                                glsl::meshPlaces(), glsl::blurCommon(), glsl::meshUnblurred()});
            break;
        case Variant::Pass::depth:
            // Opaque casters need no fragment shader at all.
            if ((variant.features & Variant::alphaMask) != 0)
                at->second = build("masked caster", defines, {glsl::meshVertex()},
                                   {glsl::meshCommon(), glsl::meshDepth()});
            else
                at->second = build("caster", defines, {glsl::meshVertex()}, {});
            break;
    }
    return at->second.id();
}

GLuint Programs::background() {
    if (!background_)
        background_ = build("background", "", {glsl::backgroundVertex()}, {glsl::background()});
    return background_.id();
}

GLuint Programs::foreground() {
    if (!foreground_)
        foreground_ = build("foreground", "", {glsl::foregroundVertex()}, {glsl::foreground()});
    return foreground_.id();
}

GLuint Programs::depthRange() {
    if (!depthRange_)
        depthRange_ = build("depth range", "", {glsl::coverVertex()}, {glsl::depthRange()});
    return depthRange_.id();
}

GLuint Programs::blurRanges() {
    if (!blurRanges_)
        blurRanges_ = build("ranges to blur", "", {glsl::coverVertex()}, {glsl::blurRanges()});
    return blurRanges_.id();
}

GLuint Programs::blurBlocks() {
    if (!blurBlocks_)
        blurBlocks_ = build("blocks to blur", "", {glsl::coverVertex()},
                            {glsl::blurCommon(), glsl::blurBlocks()});
    return blurBlocks_.id();
}

GLuint Programs::blur(bool last) {
    gl::Program& program = blur_[last ? 1 : 0];
    if (!program)
        program = build("blur", last ? "#define LAST\n" : "", {glsl::blurVertex()},
                        {glsl::blurCommon(), glsl::blur()});
    return program.id();
}

GLuint Programs::combine(const shadow::ShadowMaps::Arranged& maps) {
    gl::Program& program = combine_[{maps.mapsPerLight, maps.perspective, maps.images}];
    if (program) return program.id();
    if (maps.mapsPerLight == 0) {
        program =
            build("combine", "", {glsl::coverVertex()}, {glsl::meshCommon(), glsl::combine()});
        return program.id();
    }
    std::string defines = "#define SHADOWS\n#define PAGED_MAPS\n#define MAPS_PER_LIGHT " +
                          std::to_string(maps.mapsPerLight) + "\n";
    if (maps.perspective) defines += "#define PERSPECTIVE_MAPS\n";
    if (maps.images) {
        program = build("combine", defines, {glsl::coverVertex()},
                        {glsl::meshCommon(), glsl::factorLookup(), glsl::combine()});
        return program.id();
    }
    program = build(
        "combine", defines, {glsl::coverVertex()},
        {glsl::meshCommon(), shadow::mapsGlsl(), shadow::lookupGlsl(),
         shadow::findFilter(filter_)->shared, shadow::findFilter(filter_)->glsl, glsl::combine()});
    return program.id();
}

const Programs::Foreign& Programs::foreign(const scene::ShaderMaterial& material) {
    const auto [at, isNew] = foreign_.try_emplace(material.id());
    Foreign& made = at->second;
    if (!isNew) return made;
    const std::array stages{
        gl::ShaderStage{.type = GL_VERTEX_SHADER,
                        .parts = {glsl::version(), material.vertexSource.get()}},
        gl::ShaderStage{.type = GL_FRAGMENT_SHADER,
                        .parts = {glsl::version(), material.fragmentSource.get()}}};
    auto program = gl::buildProgram(gl_, "material of the application", stages);
    if (!program) {
        made.error = program.error().what;
        return made;
    }
    made.program = std::move(*program);
    const auto place = [&](const char* name) {
        return gl_.GetUniformLocation(made.program.id(), name);
    };
    made.clipFromLocal = place("gnomonClipFromLocal");
    made.eyeFromLocal = place("gnomonEyeFromLocal");
    made.eyeFromLocalNormal = place("gnomonEyeFromLocalNormal");
    made.time = place("gnomonTime");
    made.texture = place("gnomonTexture");
    return made;
}

}  // namespace gnomon::render
