#include "Materials.h"

#include <gnomon/base/Error.h>
#include <gnomon/demo/Textures.h>

#include <algorithm>
#include <string_view>

namespace gnomon::demo {
namespace {

/// Adds the named texture's images and a material that shows them.
Finish textured(Scene& scene, std::uint64_t seed, std::uint32_t textureShrink,
                std::string_view name, Material material) {
    for (const TextureInfo& info : textures()) {
        if (info.name != name) continue;
        Texture texture = info.make(seed, std::max(info.size / textureShrink, 16U));
        material.name = info.name;
        material.baseColourImage = scene.add(std::move(texture.colour));
        if (texture.normal) material.normalImage = scene.add(*std::move(texture.normal));
        return {.material = scene.add(std::move(material)),
                .uvPerMetre = info.metres > 0.0F ? 1.0F / info.metres : 1.0F};
    }
    throw Failure{Errc::config, "no texture named " + std::string{name}};
}

Finish plain(Scene& scene, Material material) {
    return {.material = scene.add(std::move(material)), .uvPerMetre = 1.0F};
}

/// A second material with the images of @p finish.
Finish tinted(Scene& scene, const Finish& finish, const char* name, const glm::vec4& colour,
              float roughness) {
    Material material = scene.materials[finish.material];
    material.name = name;
    material.baseColour = colour;
    material.roughness = roughness;
    return {.material = scene.add(std::move(material)), .uvPerMetre = finish.uvPerMetre};
}

}  // namespace

Materials addMaterials(Scene& scene, std::uint64_t seed, std::uint32_t textureShrink) {
    GNOMON_EXPECTS(textureShrink > 0, "textures are made smaller, not infinite");
    Materials m;
    const auto with = [&](std::string_view name, Material material) {
        return textured(scene, seed, textureShrink, name, std::move(material));
    };
    m.paving = with("paving", {.roughness = 0.75F});
    m.travertine = with("travertine", {.roughness = 0.7F});
    m.marble = with("marble", {.roughness = 0.35F});
    m.darkMarble = tinted(scene, m.marble, "dark marble", {0.06F, 0.07F, 0.065F, 1.0F}, 0.25F);
    m.plaster = with("plaster", {.roughness = 0.9F});
    m.terracotta = with("terracotta", {.roughness = 0.8F});
    m.bronze = with("bronze", {.metallic = 0.2F, .roughness = 0.45F});
    m.gold = plain(scene, {.name = "gilding",
                           .baseColour = {0.83F, 0.58F, 0.20F, 1.0F},
                           .metallic = 0.4F,
                           .roughness = 0.3F});
    m.iron = plain(scene,
                   {.name = "iron", .baseColour = {0.05F, 0.05F, 0.055F, 1.0F}, .roughness = 0.5F});
    m.bark = with("bark", {.roughness = 0.95F});
    m.wood = with("wood", {.roughness = 0.85F});
    m.grass = with("grass", {.roughness = 1.0F});
    m.roof = with("roof", {.roughness = 0.85F});
    m.water = with("water", {.normalScale = 0.6F, .roughness = 0.08F});
    m.soil = plain(scene,
                   {.name = "soil", .baseColour = {0.10F, 0.07F, 0.045F, 1.0F}, .roughness = 1.0F});
    m.lamp = plain(scene, {.name = "lamp",
                           .baseColour = {1.0F, 0.85F, 0.6F, 1.0F},
                           .roughness = 0.4F,
                           .emissive = {1.0F, 0.72F, 0.36F}});
    m.spray = plain(
        scene, {.name = "spray", .baseColour = {0.78F, 0.86F, 0.88F, 1.0F}, .roughness = 0.1F});
    m.gull = plain(scene, {.name = "gull", .baseColour = {0.82F, 0.82F, 0.80F, 1.0F}});
    m.leaves = with("leaves", {.roughness = 0.6F, .masked = true, .doubleSided = true});
    m.needles = with("needles", {.roughness = 0.8F, .masked = true, .doubleSided = true});
    m.core = plain(
        scene,
        {.name = "cypress core", .baseColour = {0.014F, 0.026F, 0.012F, 1.0F}, .roughness = 1.0F});
    m.banner = with("banner", {.roughness = 0.9F, .doubleSided = true});
    return m;
}

}  // namespace gnomon::demo
