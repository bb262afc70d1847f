#include "gltf/Materials.h"

#include <fmt/format.h>

#include <cmath>

#include "build/Phong.h"
#include "input/Report.h"
#include "input/Uri.h"

namespace gnomon::importer {

using scene::edit;
using scene::PhongMaterial;
using scene::Texture;

namespace {

scene::Texture::Wrap wrapOf(std::uint64_t code) {
    if (code == 33071) return Texture::Wrap::clamp;
    if (code == 33648) return Texture::Wrap::mirror;
    return Texture::Wrap::repeat;
}

bool finite(const math::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

math::dvec3 colorOf(const JsonView& json, const char* key, double otherwise) {
    std::array<double, 3> c{otherwise, otherwise, otherwise};
    json.numbers(key, c);
    return {c[0], c[1], c[2]};
}

}  // namespace

GltfMaterials::GltfMaterials(const GltfDocument& document, field::Aspect& aspect, Report& report)
    : document_{document},
      aspect_{aspect},
      report_{report},
      textures_{aspect, report},
      json_{document.root().objects("materials", "material")},
      texturesJson_{document.root().objects("textures", "texture")},
      imagesJson_{document.root().objects("images", "image")},
      samplersJson_{document.root().objects("samplers", "sampler")},
      made_(json_.size()) {}

const GltfMaterial& GltfMaterials::of(const JsonView& primitive) {
    const auto number = primitive.index("material", json_.size(), "materials");
    if (!number) {
        // glTF's default is a white metal, which is of no use without surroundings to mirror.
        if (!default_) default_ = GltfMaterial{.material = &aspect_.create<PhongMaterial>()};
        return *default_;
    }
    auto& made = made_[*number];
    if (!made) made = make(json_[*number]);
    return *made;
}

std::optional<std::size_t> GltfMaterials::imageOf(const JsonView& info) const {
    const auto number = info.index("index", texturesJson_.size(), "textures");
    if (!number) info.refuse("index is missing");
    const auto source = texturesJson_[*number].index("source", imagesJson_.size(), "images");
    if (!source)
        report_.warn(texturesJson_[*number].where() +
                     ": has no image in a format that is read (PNG, JPEG); left untextured");
    return source;
}

GltfMaterials::Image GltfMaterials::image(std::size_t number) const {
    const JsonView& json = imagesJson_[number];
    Image image{.name = json.where()};
    if (const auto uri = json.string("uri")) {
        if (uri->substr(0, 5) != "data:") image.name += " (" + printable(*uri, 60) + ")";
        image.source = [text = *uri, &folder = document_.folder()]() -> Result<ImageFile> {
            auto read = readUri(text, folder);
            if (!read) return tl::unexpected{std::move(read).error()};
            return ImageFile{.bytes = **read, .owner = *read};
        };
        return image;
    }
    const auto view = json.index("bufferView", document_.views().size(), "buffer views");
    if (!view) json.refuse("has neither uri nor bufferView");
    image.source = [bytes = document_.views()[*view].bytes]() -> Result<ImageFile> {
        return ImageFile{.bytes = bytes};
    };
    return image;
}

Sampler GltfMaterials::sampler(const JsonView& texture) const {
    Sampler sampler;
    const auto number = texture.index("sampler", samplersJson_.size(), "samplers");
    if (!number) return sampler;
    const JsonView& json = samplersJson_[*number];
    sampler.wrapS = wrapOf(json.unsignedInteger("wrapS", 10497));
    sampler.wrapT = wrapOf(json.unsignedInteger("wrapT", 10497));
    sampler.nearest = json.unsignedInteger("magFilter", 9729) == 9728;
    const auto minify = json.unsignedInteger("minFilter", 9987);
    sampler.mipmaps = minify != 9728 && minify != 9729;
    return sampler;
}

GltfMaterials::Mapping GltfMaterials::mapping(const JsonView& info) {
    Mapping mapping;
    auto set = info.unsignedInteger("texCoord", 0);
    if (const auto transform = info.extension("KHR_texture_transform")) {
        std::array<double, 2> offset{0.0, 0.0};
        std::array<double, 2> scale{1.0, 1.0};
        transform->numbers("offset", offset);
        transform->numbers("scale", scale);
        // Counter-clockwise in the image, whose v goes down: with the sign that the extension's own
        // test model (TextureTransformTest) and other readers use, not its text's GLSL.
        const double angle = transform->number("rotation", 0.0);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const math::vec3 rowS{math::dvec3{c * scale[0], s * scale[1], offset[0]}};
        const math::vec3 rowT{math::dvec3{-s * scale[0], c * scale[1], offset[1]}};
        if (!finite(rowS) || !finite(rowT)) transform->refuse("is not finite");
        mapping.rowS = rowS;
        mapping.rowT = rowT;
        set = transform->unsignedInteger("texCoord", set);
    }
    if (set > 63) info.refuse(fmt::format("texCoord is {}, the limit is 63", set));
    mapping.set = static_cast<std::uint32_t>(set);
    return mapping;
}

std::optional<GltfMaterials::Slot> GltfMaterials::slot(const JsonView& parent, const char* key,
                                                       bool srgb) {
    const auto info = parent.object(key);
    if (!info) return {};
    const auto number = imageOf(*info);
    if (!number) return {};
    const auto texture = *info->index("index", texturesJson_.size(), "textures");
    const Image found = image(*number);
    const auto* made =
        textures_.texture(found.name, found.source, sampler(texturesJson_[texture]), srgb);
    if (made == nullptr) return {};
    return Slot{.texture = made, .mapping = mapping(*info)};
}

/// The factors of metallic-roughness, or of the specular-glossiness extension.
void GltfMaterials::readSurface(const JsonView& json, PhongMaterial& to) {
    std::array<double, 4> base{1.0, 1.0, 1.0, 1.0};
    if (const auto glossy = json.extension("KHR_materials_pbrSpecularGlossiness")) {
        glossy->numbers("diffuseFactor", base);
        to.diffuse = math::vec4{clamped({base[0], base[1], base[2]}), clamped({base[3], 0, 0}).x};
        to.specular = clamped(colorOf(*glossy, "specularFactor", 1.0));
        to.shininess = shininessOf(1.0 - glossy->number("glossinessFactor", 1.0));
        return;
    }
    MetallicRoughness surface{.metallic = 1.0};
    if (const auto pbr = json.object("pbrMetallicRoughness")) {
        pbr->numbers("baseColorFactor", base);
        surface.metallic = pbr->number("metallicFactor", 1.0);
        surface.roughness = pbr->number("roughnessFactor", 1.0);
        // A Blinn-Phong material has one shininess: the texture's mean stands for the texture.
        if (const auto info = pbr->object("metallicRoughnessTexture"))
            if (const auto number = imageOf(*info)) {
                const Image found = image(*number);
                const auto decoded = textures_.image(found.name, found.source);
                const ImageMean mean = decoded ? meanOf(*decoded) : ImageMean{.green = 1.0};
                surface.metallic *= mean.blue;
                surface.roughness *= mean.green;
            }
    }
    surface.base = math::vec4{math::dvec4{base[0], base[1], base[2], base[3]}};
    setMetallicRoughness(to, surface);
}

GltfMaterial GltfMaterials::make(const JsonView& json) {
    const auto& material = aspect_.create<PhongMaterial>();
    GltfMaterial made{.material = &material};
    const auto e = edit(material);
    readSurface(json, *e);
    e->doubleSided = json.boolean("doubleSided", false);
    e->unlit = json.extension("KHR_materials_unlit").has_value();
    const auto mode = json.string("alphaMode", "OPAQUE");
    if (mode == "MASK") e->alpha = PhongMaterial::Alpha::mask;
    if (mode == "BLEND") e->alpha = PhongMaterial::Alpha::blend;
    e->alphaCutoff = static_cast<float>(std::clamp(json.number("alphaCutoff", 0.5), 0.0, 1.0e3));
    double strength = 1.0;
    if (const auto extension = json.extension("KHR_materials_emissive_strength"))
        strength = extension->number("emissiveStrength", 1.0);
    e->emissive = clamped(colorOf(json, "emissiveFactor", 0.0) * strength, 1.0e4);

    // One mapping serves all textures of a PhongMaterial: that of the first there is.
    std::optional<Mapping> first;
    const auto fitting = [&](const JsonView& parent, const char* key, bool srgb) {
        const auto found = slot(parent, key, srgb);
        if (!found) return static_cast<const Texture*>(nullptr);
        if (first && *first != found->mapping) {
            report_.warn(
                fmt::format("{}: {} left out: it has other texture coordinates than the "
                            "material's first texture",
                            json.where(), key));
            return static_cast<const Texture*>(nullptr);
        }
        first = found->mapping;
        return found->texture;
    };
    if (const auto glossy = json.extension("KHR_materials_pbrSpecularGlossiness")) {
        if (const auto* map = fitting(*glossy, "diffuseTexture", true)) e->diffuseMap = *map;
    } else if (const auto pbr = json.object("pbrMetallicRoughness")) {
        if (const auto* map = fitting(*pbr, "baseColorTexture", true)) e->diffuseMap = *map;
    }
    if (const auto* map = fitting(json, "normalTexture", false)) {
        e->normalMap = *map;
        e->normalScale = static_cast<float>(
            std::clamp(json.object("normalTexture")->number("scale", 1.0), -1.0e3, 1.0e3));
        made.normalMap = true;
    }
    if (const auto* map = fitting(json, "emissiveTexture", true)) e->emissiveMap = *map;
    if (first) {
        made.textured = true;
        made.texCoordSet = first->set;
        e->texRowS = first->rowS;
        e->texRowT = first->rowT;
    }
    return made;
}

}  // namespace gnomon::importer
