#include "obj/ObjMaterials.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "build/Phong.h"

namespace gnomon::importer {

using scene::edit;
using scene::PhongMaterial;

namespace {

/// Has texels that a mask would leave out.
bool hasHoles(const scene::Texture& texture) {
    const auto pixels = texture.pixels->bytes();
    for (std::size_t i = 3; i < pixels.size(); i += 4)
        if (pixels[i] < std::byte{128}) return true;
    return false;
}

std::string label(const std::string& file) { return "texture " + printable(file); }

}  // namespace

void ObjMaterials::addLibrary(const std::string& name) {
    const auto text = folder_.read(name);
    if (!text) {
        report_.warn("mtllib: " + text.error().text());
        return;
    }
    parseMtl(asText(**text), printable(name), library_, report_);
}

ImageSource ObjMaterials::source(const std::string& file) {
    return [this, file]() -> Result<ImageFile> {
        auto bytes = folder_.read(file);
        if (!bytes) {
            // Written with the folders of the machine it comes from, but lying here: common.
            auto nearby = folder_.read(std::filesystem::path{file}.filename().string());
            if (!nearby) return tl::unexpected{std::move(bytes).error()};
            bytes = std::move(nearby);
        }
        return ImageFile{.bytes = **bytes, .owner = *bytes};
    };
}

std::optional<Image> ObjMaterials::load(const std::string& file) {
    return textures_.image(label(file), source(file));
}

void ObjMaterials::setDiffuse(const MtlMaterial& from, PhongMaterial& to) {
    const scene::Texture* texture = nullptr;
    bool masked = false;
    if (!from.alphaMap.empty() && !from.diffuseMap.empty() && from.alphaMap != from.diffuseMap) {
        texture = textures_.madeTexture(
            label(from.diffuseMap) + " with alpha of " + printable(from.alphaMap),
            [&]() -> std::optional<Image> {
                auto image = load(from.diffuseMap);
                if (!image) return {};
                if (const auto mask = load(from.alphaMap)) putAlpha(*image, *mask);
                return image;
            },
            {}, true);
    } else if (!from.diffuseMap.empty()) {
        texture = textures_.texture(label(from.diffuseMap), source(from.diffuseMap), {}, true);
    } else if (!from.alphaMap.empty()) {
        texture = textures_.madeTexture(
            "white with alpha of " + printable(from.alphaMap),
            [&]() -> std::optional<Image> {
                auto mask = load(from.alphaMap);
                if (!mask) return {};
                Image white{.width = mask->width, .height = mask->height};
                white.pixels.assign(mask->pixels.size(), std::byte{255});
                putAlpha(white, *mask);
                return white;
            },
            {}, true);
    }
    if (texture != nullptr) {
        to.diffuseMap = *texture;
        masked = hasHoles(*texture);
    }
    const float alpha = clamped(math::dvec3{from.alpha}).x;
    to.diffuse = math::vec4{clamped(from.diffuse), alpha};
    if (masked)
        to.alpha = PhongMaterial::Alpha::mask;
    else if (alpha < 1.0F)
        to.alpha = PhongMaterial::Alpha::blend;
}

void ObjMaterials::setNormals(const MtlMaterial& from, PhongMaterial& to) {
    const scene::Texture* texture = nullptr;
    if (!from.normalMap.empty()) {
        texture = textures_.texture(label(from.normalMap), source(from.normalMap), {}, false);
    } else if (!from.bumpMap.empty()) {
        texture = textures_.madeTexture(
            fmt::format("{} as normals, {:g}", label(from.bumpMap), from.bumpScale),
            [&]() -> std::optional<Image> {
                auto image = load(from.bumpMap);
                // Heights are grey; many files name a normal map here.
                if (image && isGrey(*image)) {
                    constexpr float heightsPerTexel = 4.0F;  // what -bm 1 looks like elsewhere
                    return normalsFromHeights(*image,
                                              heightsPerTexel * static_cast<float>(from.bumpScale));
                }
                return image;
            },
            {}, false);
    }
    if (texture != nullptr) to.normalMap = *texture;
}

const PhongMaterial& ObjMaterials::get(const std::string& name) {
    auto& made = made_[name];
    if (made != nullptr) return *made;
    made = &aspect_.create<PhongMaterial>();
    const auto found = library_.find(name);
    if (found == library_.end()) {
        if (!name.empty())
            report_.warn(
                fmt::format("material \"{}\" is not defined; drawn grey", printable(name)));
        return *made;
    }
    const MtlMaterial& from = found->second;
    auto e = edit(*made);
    setDiffuse(from, *e);
    setNormals(from, *e);
    e->specular = clamped(from.specular);
    e->shininess = clamped(math::dvec3{std::max(from.shininess, 2.0)}, 2048.0).x;
    e->emissive = clamped(from.emissive, 1.0e4);
    if (!from.emissiveMap.empty())
        if (const auto* map =
                textures_.texture(label(from.emissiveMap), source(from.emissiveMap), {}, true))
            e->emissiveMap = *map;
    return *made;
}

const PhongMaterial& ObjMaterials::textured(const std::string& image) {
    auto& material = library_["texture " + image];
    material.diffuse = math::dvec3{1.0};
    material.diffuseMap = image;
    return get("texture " + image);
}

}  // namespace gnomon::importer
