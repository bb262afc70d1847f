#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/scene/Geometry.h>

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "RangeAllocator.h"

namespace gnomon::render {

/// Which attributes a vertex has besides its position.
enum MeshFormat : std::uint32_t {
    hasNormals = 1,
    hasTexCoords = 2,
    hasTangents = 4,
    hasColors = 8,
};

/// All geometries on the GPU, in a few large buffers: one set for each combination of attributes,
/// so that a batch of draws needs no rebinding.
class MeshStore {
public:
    /// Vertex attribute locations.
    static constexpr GLuint positionAt = 0, normalAt = 1, texCoordAt = 2, tangentAt = 3,
                            colorAt = 4, instanceAt = 5;  // 5..7 rows, 8 info
    static constexpr GLuint instanceBinding = 5;

    struct Mesh {
        std::uint32_t format = 0;
        std::uint32_t baseVertex = 0;
        std::uint32_t vertexCount = 0;
        std::uint32_t firstIndex = 0;
        std::uint32_t indexCount = 0;
        bool valid = false;  ///< false: broken data, draws nothing
    };

    explicit MeshStore(const gl::Api& gl) : gl_{gl} {}

    /// Uploads it the first time. Data that does not fit together (an index out of range) makes an
    /// invalid mesh.
    const Mesh& get(const scene::Geometry& geometry);
    void forget(field::Id geometry);

    /// Vertex array with all attributes of a format, or with positions alone for depth passes.
    GLuint vertexArray(std::uint32_t format, bool positionsOnly) const;
    /// The per-instance buffer all vertex arrays read: rows of originFromLocal and a uvec4.
    void useInstances(GLuint buffer, GLsizei stride);

private:
    struct Arena {
        RangeAllocator vertices;
        RangeAllocator indices;
        gl::Buffer streams[5];
        gl::Buffer elements;
        gl::VertexArray full;
        gl::VertexArray positionsOnly;
    };
    void upload(const scene::Geometry& geometry, Mesh& mesh);
    void makeVertexArrays(Arena& arena, std::uint32_t format);
    void growVertices(Arena& arena, std::uint32_t format, std::uint32_t atLeast);
    void growIndices(Arena& arena, std::uint32_t format, std::uint32_t atLeast);

    const gl::Api& gl_;
    std::map<std::uint32_t, Arena> arenas_;
    std::unordered_map<field::Id, Mesh> meshes_;
    GLuint instances_ = 0;
    GLsizei instanceStride_ = 0;
};

}  // namespace gnomon::render
