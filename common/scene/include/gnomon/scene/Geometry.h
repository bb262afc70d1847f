#pragma once

#include <gnomon/scene/Node.h>

namespace gnomon::scene {

enum class Primitive { triangles, lines, points, last = points };

/// A run of indices that lies together in space: the unit of culling, about a thousand triangles.
struct Chunk {
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
    /// Whole closed surfaces only (each edge is shared by exactly two faces that agree in winding),
    /// so that one of its two sides can be left out of a shadow map. A closed surface may be spread
    /// over several chunks that are all marked.
    bool closed = false;
    math::vec3 min{0.0F};
    math::vec3 max{0.0F};
    friend bool operator==(const Chunk&, const Chunk&) = default;
};

/// Vertices and what they form. All positions and indices are finite and in range: importers and
/// the server see to it.
class Geometry final : public Container<Geometry, NodeCore> {
public:
    static constexpr std::string_view typeName = "Geometry";

    Field<Primitive> primitive;
    Field<Payload> positions;  ///< vec3 float, local space, metres
    Field<Payload> normals;    ///< vec3 float, unit; empty: the faces' own
    Field<Payload> texCoords;  ///< vec2 float, v = 0 is the image's top row; or empty
    Field<Payload> tangents;   ///< vec4 float, w = handedness; or empty
    Field<Payload> colors;     ///< 4 x u8, linear, multiplies the material's; or empty
    Field<Payload> indices;    ///< u32; two for a line, three for a triangle, ordered by chunk
    MultiField<Chunk> chunks;  ///< together cover all indices
    Field<math::vec3> boundsMin;
    Field<math::vec3> boundsMax;

    static constexpr auto fields() {
        return std::tuple{
            entry("primitive", &Geometry::primitive), entry("positions", &Geometry::positions),
            entry("normals", &Geometry::normals),     entry("texCoords", &Geometry::texCoords),
            entry("tangents", &Geometry::tangents),   entry("colors", &Geometry::colors),
            entry("indices", &Geometry::indices),     entry("chunks", &Geometry::chunks),
            entry("boundsMin", &Geometry::boundsMin), entry("boundsMax", &Geometry::boundsMax)};
    }
};

}  // namespace gnomon::scene

namespace gnomon::field {

/// u32 firstIndex, u32 indexCount, bool closed, 3 float min, 3 float max.
template <>
struct FieldTraits<scene::Chunk> {
    static constexpr std::string_view layout = "uubffffff";
    static void write(Writer& to, const scene::Chunk& chunk);
    static scene::Chunk read(Reader& from);
};

}  // namespace gnomon::field
