#include "other/AssimpMaterials.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>

#include "build/Phong.h"

namespace gnomon::importer {

using scene::edit;
using scene::PhongMaterial;

namespace {

std::optional<math::dvec3> colorOf(const aiMaterial& material, const char* key, unsigned type,
                                   unsigned index) {
    aiColor3D color;
    if (material.Get(key, type, index, color) != AI_SUCCESS) return {};
    return math::dvec3{color.r, color.g, color.b};
}

std::optional<float> floatOf(const aiMaterial& material, const char* key, unsigned type,
                             unsigned index) {
    float value = 0.0F;
    if (material.Get(key, type, index, value) != AI_SUCCESS) return {};
    return value;
}

/// Texels that a file carries undecoded, as 8-bit BGRA.
Image embeddedImage(const aiTexture& texture) {
    Image image{.width = static_cast<int>(texture.mWidth),
                .height = static_cast<int>(texture.mHeight),
                .hasAlpha = true};
    const std::size_t count = std::size_t{texture.mWidth} * texture.mHeight;
    image.pixels.reserve(count * 4);
    for (std::size_t i = 0; i < count; ++i) {
        const aiTexel& t = texture.pcData[i];
        for (const auto c : {t.r, t.g, t.b, t.a}) image.pixels.push_back(std::byte{c});
    }
    return image;
}

}  // namespace

const scene::Texture* AssimpMaterials::texture(const aiMaterial& material, aiTextureType type,
                                               bool srgb) {
    aiString path;
    aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (material.GetTexture(type, 0, &path, nullptr, nullptr, nullptr, nullptr, modes) !=
        AI_SUCCESS)
        return nullptr;
    const auto wrap = [](aiTextureMapMode mode) {
        if (mode == aiTextureMapMode_Mirror) return scene::Texture::Wrap::mirror;
        return mode == aiTextureMapMode_Wrap ? scene::Texture::Wrap::repeat
                                             : scene::Texture::Wrap::clamp;
    };
    const Sampler sampler{.wrapS = wrap(modes[0]), .wrapT = wrap(modes[1])};
    std::string name = path.C_Str();
    std::replace(name.begin(), name.end(), '\\', '/');
    const auto label = "texture " + printable(name);
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(path.C_Str())) {
        if (embedded->mHeight > 0) {
            if (embedded->mWidth > static_cast<unsigned>(maxImageSide) ||
                embedded->mHeight > static_cast<unsigned>(maxImageSide))
                return nullptr;
            return textures_.madeTexture(
                label, [&] { return embeddedImage(*embedded); }, sampler, srgb);
        }
        const auto bytes = std::as_bytes(std::span{reinterpret_cast<const char*>(embedded->pcData),
                                                   std::size_t{embedded->mWidth}});
        return textures_.texture(
            label, [bytes]() -> Result<ImageFile> { return ImageFile{.bytes = bytes}; }, sampler,
            srgb);
    }
    return textures_.texture(
        label,
        [&]() -> Result<ImageFile> {
            auto read = folder_.read(name);
            if (!read) {
                auto nearby = folder_.read(std::filesystem::path{name}.filename().string());
                if (!nearby) return tl::unexpected{std::move(read).error()};
                read = std::move(nearby);
            }
            return ImageFile{.bytes = **read, .owner = *read};
        },
        sampler, srgb);
}

void AssimpMaterials::read(const aiMaterial& from, PhongMaterial& to) {
    const float opacity = floatOf(from, AI_MATKEY_OPACITY).value_or(1.0F);
    const float alpha = clamped(math::dvec3{double{opacity}}).x;
    const auto metallic = floatOf(from, AI_MATKEY_METALLIC_FACTOR);
    const auto roughness = floatOf(from, AI_MATKEY_ROUGHNESS_FACTOR);
    const auto base = colorOf(from, AI_MATKEY_BASE_COLOR);
    if (base && metallic) {
        setMetallicRoughness(to, {.base = math::vec4{clamped(*base), alpha},
                                  .metallic = double{*metallic},
                                  .roughness = double{roughness.value_or(1.0F)}});
    } else {
        const auto diffuse = colorOf(from, AI_MATKEY_COLOR_DIFFUSE).value_or(math::dvec3{0.8});
        to.diffuse = math::vec4{clamped(diffuse), alpha};
        const auto specular = colorOf(from, AI_MATKEY_COLOR_SPECULAR).value_or(math::dvec3{0.0});
        const double strength = double{floatOf(from, AI_MATKEY_SHININESS_STRENGTH).value_or(1.0F)};
        to.specular = clamped(specular * strength);
        const double shininess = double{floatOf(from, AI_MATKEY_SHININESS).value_or(0.0F)};
        to.shininess = clamped(math::dvec3{std::max(shininess, 2.0)}, 2048.0).x;
    }
    to.emissive =
        clamped(colorOf(from, AI_MATKEY_COLOR_EMISSIVE).value_or(math::dvec3{0.0}), 1.0e4);
    int twoSided = 0;
    if (from.Get(AI_MATKEY_TWOSIDED, twoSided) == AI_SUCCESS) to.doubleSided = twoSided != 0;
    const auto* map = texture(from, aiTextureType_BASE_COLOR, true);
    if (map == nullptr) map = texture(from, aiTextureType_DIFFUSE, true);
    if (map != nullptr) to.diffuseMap = *map;
    if (const auto* normals = texture(from, aiTextureType_NORMALS, false)) to.normalMap = *normals;
    if (const auto* glow = texture(from, aiTextureType_EMISSIVE, true)) to.emissiveMap = *glow;
    if (alpha < 1.0F) to.alpha = PhongMaterial::Alpha::blend;
}

const PhongMaterial& AssimpMaterials::get(unsigned number) {
    if (number >= made_.size()) {
        if (default_ == nullptr) default_ = &aspect_.create<PhongMaterial>();
        return *default_;
    }
    auto& made = made_[number];
    if (made == nullptr) {
        made = &aspect_.create<PhongMaterial>();
        read(*scene_.mMaterials[number], *edit(*made));
    }
    return *made;
}

}  // namespace gnomon::importer
