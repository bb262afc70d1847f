#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gnomon::demo {

/// A corner of a triangle. Texture coordinates follow glTF: v grows downwards in the image, so a
/// wall seen from outside has u growing to the right and v growing downwards.
struct Vertex {
    glm::vec3 position{0.0F};  ///< metres
    glm::vec3 normal{0.0F, 1.0F, 0.0F};
    glm::vec2 uv{0.0F};

    bool operator==(const Vertex&) const = default;
};

/// Triangles, counter-clockwise seen from the side their normals point to.
struct Mesh {
    std::vector<Vertex> vertices = {};
    std::vector<std::uint32_t> indices = {};  ///< three a triangle

    std::size_t triangles() const { return indices.size() / 3; }
};

/// Adds a triangle; one that has two corners at one place is left out, so that the poles of
/// lathes and spheres need no special case.
void addTriangle(Mesh& mesh, const Vertex& a, const Vertex& b, const Vertex& c);

/// Two triangles abc, acd.
void addQuad(Mesh& mesh, const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d);

/// A flat polygon of three or more corners with its geometric normal and a texture laid on it in
/// metres. It may be concave but not touch itself, apart from slits (see Polygon.h).
/// @param uvPerMetre  Repeats of the texture a metre.
void addPolygon(Mesh& mesh, std::span<const glm::vec3> corners, float uvPerMetre);

/// Texture coordinates of a flat surface with @p normal: up stays up, and left is not mirrored.
glm::vec2 planarUv(const glm::vec3& position, const glm::vec3& normal, float uvPerMetre);

/// Adds @p part, transformed. A mirroring transform flips the winding, so closed stays outward.
void append(Mesh& mesh, const Mesh& part, const glm::mat4& meshFromPart = glm::mat4{1.0F});

/// The same triangles with equal vertices stored once, in order of first use.
Mesh welded(const Mesh& mesh);

}  // namespace gnomon::demo
