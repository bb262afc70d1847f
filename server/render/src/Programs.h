#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/scene/Material.h>
#include <gnomon/shadow/ShadowMaps.h>

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace gnomon::render {

/// What a built-in program is specialised for.
struct Variant {
    enum class Pass : std::uint8_t { color, depth, factor, unblurred };
    enum Feature : std::uint32_t {
        diffuseMap = 1,
        normalMap = 2,
        emissiveMap = 4,
        alphaMask = 8,
        unlit = 16,
        scopedLights = 32,
        shadows = 64,
        manyLights = 128,       ///< more lights than are written out
        pagedMaps = 256,        ///< some shadow map has several pages
        perspectiveMaps = 512,  ///< some shadow map has a w that is not 1
        factorImages = 1024,    ///< factors are read, not found in maps
    };
    static constexpr int maxDirectional = 4;  ///< directional lights a program is written out for
    static constexpr int maxOther = 8;        ///< and others
    static constexpr int maxPlaces = 6;       ///< lights whose place in a map is interpolated
    Pass pass = Pass::color;
    std::uint32_t format = 0;  ///< MeshFormat
    std::uint32_t features = 0;
    int directionalLights = 0;
    int otherLights = 0;
    int mapsPerLight = 0;  ///< with shadows
    int shadowLights = 0;  ///< the first so many lights can have maps
    int places = 0;        ///< the first so many lights' places come from the vertex shader
    int firstLight = 0;    ///< of pass unblurred
    int lightCount = 0;
    friend auto operator<=>(const Variant&, const Variant&) = default;
};

/// Programs, each built the first time it is needed and kept.
class Programs {
public:
    explicit Programs(const gl::Api& gl) : gl_{gl} {}

    /// The shadow filter that lookups use from now on; a new one rebuilds what depends on it.
    void useFilter(std::string_view name);
    /// @throws Failure Errc::shader when the driver refuses our own text.
    GLuint mesh(const Variant& variant);
    GLuint background();
    GLuint foreground();
    GLuint depthRange();
    /// The passes of ScreenBlur.
    GLuint blurRanges();
    GLuint blurBlocks();
    /// @param last  it makes factors, not surfaces
    GLuint blur(bool last);
    GLuint combine(const shadow::ShadowMaps::Arranged& maps);

    /// A material's own program, with the places of the uniforms it declares. id 0: it does not
    /// compile; error says why.
    struct Foreign {
        gl::Program program = {};
        GLint clipFromLocal = -1, eyeFromLocal = -1, eyeFromLocalNormal = -1, time = -1,
              texture = -1;
        std::string error = {};
    };
    const Foreign& foreign(const scene::ShaderMaterial& material);
    void forgetForeign(field::Id material) { foreign_.erase(material); }

private:
    gl::Program build(std::string_view label, std::string_view defines,
                      std::initializer_list<std::string_view> vertex,
                      std::initializer_list<std::string_view> fragment) const;

    const gl::Api& gl_;
    std::string filter_ = "hard";
    std::map<Variant, gl::Program> meshes_;
    gl::Program background_;
    gl::Program foreground_;
    gl::Program depthRange_;
    gl::Program blurRanges_;
    gl::Program blurBlocks_;
    std::array<gl::Program, 2> blur_;                             ///< the last pass is the second
    std::map<std::tuple<int, bool, bool>, gl::Program> combine_;  ///< as Arranged
    std::unordered_map<field::Id, Foreign> foreign_;
};

}  // namespace gnomon::render
