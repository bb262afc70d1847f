#pragma once

#include <gnomon/scene/Node.h>

namespace gnomon::scene {

/// An image for materials and foregrounds.
class Texture final : public Container<Texture> {
public:
    static constexpr std::string_view typeName = "Texture";
    enum class Wrap { repeat, mirror, clamp, last = clamp };

    Field<Payload> pixels;   ///< rgba8, top row first
    Field<glm::ivec2> size;  ///< pixels
    Field<bool> srgb;        ///< colour data; false for normal maps
    Field<Wrap> wrapS;
    Field<Wrap> wrapT;
    Field<bool> mipmaps{true};
    Field<bool> nearest;  ///< no interpolation
    Field<float> anisotropy{8.0F};

    static constexpr auto fields() {
        return std::tuple{
            entry("pixels", &Texture::pixels),   entry("size", &Texture::size),
            entry("srgb", &Texture::srgb),       entry("wrapS", &Texture::wrapS),
            entry("wrapT", &Texture::wrapT),     entry("mipmaps", &Texture::mipmaps),
            entry("nearest", &Texture::nearest), entry("anisotropy", &Texture::anisotropy)};
    }
};

/// How a surface looks.
class Material : public field::FieldContainer {};

/// Blinn-Phong, in linear light. Colours are linear RGB.
class PhongMaterial final : public Container<PhongMaterial, Material> {
public:
    static constexpr std::string_view typeName = "PhongMaterial";
    enum class Alpha { opaque, mask, blend, last = blend };

    Field<math::vec4> diffuse{math::vec4{0.8F, 0.8F, 0.8F, 1.0F}};
    Field<math::vec3> specular{math::vec3{0.04F}};
    Field<math::vec3> emissive;
    Field<float> shininess{32.0F};
    Field<Ref<Texture>> diffuseMap;
    Field<Ref<Texture>> normalMap;  ///< tangent space, +y up
    Field<float> normalScale{1.0F};
    Field<Ref<Texture>> emissiveMap;
    Field<Alpha> alpha;
    Field<float> alphaCutoff{0.5F};
    Field<bool> doubleSided;
    Field<bool> unlit;
    /// Row-major 2x3: texture coordinate = xyz . (u, v, 1) for each row.
    Field<math::vec3> texRowS{math::vec3{1.0F, 0.0F, 0.0F}};
    Field<math::vec3> texRowT{math::vec3{0.0F, 1.0F, 0.0F}};

    static constexpr auto fields() {
        using M = PhongMaterial;
        return std::tuple{entry("diffuse", &M::diffuse),
                          entry("specular", &M::specular),
                          entry("emissive", &M::emissive),
                          entry("shininess", &M::shininess),
                          entry("diffuseMap", &M::diffuseMap),
                          entry("normalMap", &M::normalMap),
                          entry("normalScale", &M::normalScale),
                          entry("emissiveMap", &M::emissiveMap),
                          entry("alpha", &M::alpha),
                          entry("alphaCutoff", &M::alphaCutoff),
                          entry("doubleSided", &M::doubleSided),
                          entry("unlit", &M::unlit),
                          entry("texRowS", &M::texRowS),
                          entry("texRowT", &M::texRowT)};
    }
};

/// A material with shaders of the application's own, which know nothing of shadows: the viewport
/// darkens what they drew. GLSL 4.50 core without the #version line. Vertex inputs: location 0
/// vec3 position, 1 vec3 normal, 2 vec2 texCoord, 3 vec4 tangent, 4 vec4 color. Uniforms, where
/// declared: mat4 gnomonClipFromLocal, mat4 gnomonEyeFromLocal, mat3 gnomonEyeFromLocalNormal,
/// float gnomonTime (seconds), sampler2D gnomonTexture. The fragment shader writes linear colour
/// to location 0.
class ShaderMaterial final : public Container<ShaderMaterial, Material> {
public:
    static constexpr std::string_view typeName = "ShaderMaterial";
    Field<std::string> vertexSource;
    Field<std::string> fragmentSource;
    Field<Ref<Texture>> texture;
    Field<bool> doubleSided;

    static constexpr auto fields() {
        return std::tuple{entry("vertexSource", &ShaderMaterial::vertexSource),
                          entry("fragmentSource", &ShaderMaterial::fragmentSource),
                          entry("texture", &ShaderMaterial::texture),
                          entry("doubleSided", &ShaderMaterial::doubleSided)};
    }
};

/// Gives its subtree a material; the nearest one above a geometry counts.
class MaterialGroup final : public Container<MaterialGroup, NodeCore> {
public:
    static constexpr std::string_view typeName = "MaterialGroup";
    Field<Ref<Material>> material;
    static constexpr auto fields() {
        return std::tuple{entry("material", &MaterialGroup::material)};
    }
};

}  // namespace gnomon::scene
