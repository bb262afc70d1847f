#include "MeshStore.h"

#include <algorithm>
#include <array>

namespace gnomon::render {
namespace {

struct Stream {
    std::uint32_t bit;  ///< 0: always there
    GLsizei bytes;
    GLint components;
    GLenum type;
    GLboolean normalized;
};
constexpr std::array<Stream, 5> streams{{{0, 12, 3, GL_FLOAT, GL_FALSE},
                                         {hasNormals, 12, 3, GL_FLOAT, GL_FALSE},
                                         {hasTexCoords, 8, 2, GL_FLOAT, GL_FALSE},
                                         {hasTangents, 16, 4, GL_FLOAT, GL_FALSE},
                                         {hasColors, 4, 4, GL_UNSIGNED_BYTE, GL_TRUE}}};

bool has(std::uint32_t format, const Stream& stream) {
    return stream.bit == 0 || (format & stream.bit) != 0;
}

std::array<const field::Payload*, 5> payloads(const scene::Geometry& g) {
    return {&g.positions.get(), &g.normals.get(), &g.texCoords.get(), &g.tangents.get(),
            &g.colors.get()};
}

gl::Buffer enlarged(const gl::Api& gl, const gl::Buffer& old, std::uint64_t oldBytes,
                    std::uint64_t newBytes, std::string_view label) {
    gl::Buffer buffer{gl};
    buffer.label(label);
    gl.NamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(newBytes), nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    if (old && oldBytes > 0)
        gl.CopyNamedBufferSubData(old.id(), buffer.id(), 0, 0, static_cast<GLsizeiptr>(oldBytes));
    return buffer;
}

std::uint32_t nextCapacity(std::uint32_t now, std::uint32_t more) {
    return std::max({now + more, now + now / 2, 4096U});
}

}  // namespace

const MeshStore::Mesh& MeshStore::get(const scene::Geometry& geometry) {
    const auto [at, isNew] = meshes_.try_emplace(geometry.id());
    if (isNew) upload(geometry, at->second);
    return at->second;
}

void MeshStore::forget(field::Id geometry) {
    const auto found = meshes_.find(geometry);
    if (found == meshes_.end()) return;
    const Mesh& mesh = found->second;
    if (mesh.valid) {
        Arena& arena = arenas_.at(mesh.format);
        arena.vertices.give(mesh.baseVertex, mesh.vertexCount);
        arena.indices.give(mesh.firstIndex, mesh.indexCount);
    }
    meshes_.erase(found);
}

void MeshStore::upload(const scene::Geometry& geometry, Mesh& mesh) {
    const auto data = payloads(geometry);
    const std::size_t vertices = data[0]->size() / 12;
    const auto indices = geometry.indices->as<std::uint32_t>();
    if (vertices == 0 || indices.empty() || vertices > 0x7fffffffU || indices.size() > 0x7fffffffU)
        return;
    for (const std::uint32_t index : indices)
        if (index >= vertices) return;
    for (const scene::Chunk& chunk : geometry.chunks)
        if (chunk.firstIndex > indices.size() ||
            chunk.indexCount > indices.size() - chunk.firstIndex)
            return;
    for (std::size_t i = 1; i < streams.size(); ++i)
        if (data[i]->size() == vertices * static_cast<std::size_t>(streams[i].bytes))
            mesh.format |= streams[i].bit;
    mesh.vertexCount = static_cast<std::uint32_t>(vertices);
    mesh.indexCount = static_cast<std::uint32_t>(indices.size());

    Arena& arena = arenas_[mesh.format];
    auto vertexAt = arena.vertices.take(mesh.vertexCount);
    if (!vertexAt) {
        growVertices(arena, mesh.format, mesh.vertexCount);
        vertexAt = arena.vertices.take(mesh.vertexCount);
    }
    auto indexAt = arena.indices.take(mesh.indexCount);
    if (!indexAt) {
        growIndices(arena, mesh.format, mesh.indexCount);
        indexAt = arena.indices.take(mesh.indexCount);
    }
    mesh.baseVertex = vertexAt.value();
    mesh.firstIndex = indexAt.value();
    for (std::size_t i = 0; i < streams.size(); ++i) {
        if (!has(mesh.format, streams[i])) continue;
        gl_.NamedBufferSubData(
            arena.streams[i].id(), static_cast<GLintptr>(mesh.baseVertex) * streams[i].bytes,
            static_cast<GLsizeiptr>(vertices) * streams[i].bytes, data[i]->bytes().data());
    }
    gl_.NamedBufferSubData(arena.elements.id(), static_cast<GLintptr>(mesh.firstIndex) * 4,
                           static_cast<GLsizeiptr>(indices.size_bytes()), indices.data());
    mesh.valid = true;
}

void MeshStore::growVertices(Arena& arena, std::uint32_t format, std::uint32_t more) {
    const std::uint32_t before = arena.vertices.capacity();
    arena.vertices.grow(nextCapacity(before, more));
    for (std::size_t i = 0; i < streams.size(); ++i) {
        if (!has(format, streams[i])) continue;
        const auto bytes = static_cast<std::uint64_t>(streams[i].bytes);
        arena.streams[i] = enlarged(gl_, arena.streams[i], before * bytes,
                                    arena.vertices.capacity() * bytes, "vertices");
    }
    makeVertexArrays(arena, format);
}

void MeshStore::growIndices(Arena& arena, std::uint32_t format, std::uint32_t more) {
    const std::uint64_t before = arena.indices.capacity();
    arena.indices.grow(nextCapacity(arena.indices.capacity(), more));
    arena.elements =
        enlarged(gl_, arena.elements, before * 4U, arena.indices.capacity() * 4ULL, "indices");
    makeVertexArrays(arena, format);
}

void MeshStore::makeVertexArrays(Arena& arena, std::uint32_t format) {
    for (gl::VertexArray* array : {&arena.full, &arena.positionsOnly}) {
        *array = gl::VertexArray{gl_};
        array->label("meshes");
        const GLuint id = array->id();
        for (std::size_t i = 0; i < streams.size(); ++i) {
            const auto at = static_cast<GLuint>(i);
            if (!has(format, streams[i]) || !arena.streams[i]) continue;
            // A masked caster needs texture coordinates too; they cost nothing where unused.
            if (array == &arena.positionsOnly && i != positionAt && i != texCoordAt && i != colorAt)
                continue;
            gl_.VertexArrayVertexBuffer(id, at, arena.streams[i].id(), 0, streams[i].bytes);
            gl_.VertexArrayAttribFormat(id, at, streams[i].components, streams[i].type,
                                        streams[i].normalized, 0);
            gl_.VertexArrayAttribBinding(id, at, at);
            gl_.EnableVertexArrayAttrib(id, at);
        }
        for (GLuint row = 0; row < 3; ++row) {
            gl_.VertexArrayAttribFormat(id, instanceAt + row, 4, GL_FLOAT, GL_FALSE, row * 16);
            gl_.VertexArrayAttribBinding(id, instanceAt + row, instanceBinding);
            gl_.EnableVertexArrayAttrib(id, instanceAt + row);
        }
        gl_.VertexArrayAttribIFormat(id, instanceAt + 3, 4, GL_UNSIGNED_INT, 48);
        gl_.VertexArrayAttribBinding(id, instanceAt + 3, instanceBinding);
        gl_.EnableVertexArrayAttrib(id, instanceAt + 3);
        gl_.VertexArrayBindingDivisor(id, instanceBinding, 1);
        if (arena.elements) gl_.VertexArrayElementBuffer(id, arena.elements.id());
        if (instances_ != 0)
            gl_.VertexArrayVertexBuffer(id, instanceBinding, instances_, 0, instanceStride_);
    }
}

GLuint MeshStore::vertexArray(std::uint32_t format, bool positionsOnly) const {
    const Arena& arena = arenas_.at(format);
    return positionsOnly ? arena.positionsOnly.id() : arena.full.id();
}

void MeshStore::useInstances(GLuint buffer, GLsizei stride) {
    instances_ = buffer;
    instanceStride_ = stride;
    for (auto& [format, arena] : arenas_)
        for (gl::VertexArray* array : {&arena.full, &arena.positionsOnly})
            if (*array)
                gl_.VertexArrayVertexBuffer(array->id(), instanceBinding, buffer, 0, stride);
}

}  // namespace gnomon::render
