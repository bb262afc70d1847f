#include "PeerScene.h"

#include <array>
#include <fstream>
#include <unordered_map>

namespace gnomon::client {
namespace {

struct Part {
    std::vector<math::vec3> vertices = {};
    std::vector<std::uint32_t> indices = {};
};

/// A chunk with the vertices it uses alone.
Part partOf(const scene::FlatScene& flat, const scene::FlatScene::Instance& instance,
            const scene::Chunk& chunk) {
    // glm's vectors have constructors here, so bytes cannot be seen as them.
    const auto positions = instance.geometry->positions->as<std::array<float, 3>>();
    const auto indices = instance.geometry->indices->as<std::uint32_t>();
    const math::dmat4& world = flat.worldFromLocal(instance);
    Part part;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (const std::uint32_t index : indices.subspan(chunk.firstIndex, chunk.indexCount)) {
        const auto [at, isNew] =
            numbers.try_emplace(index, static_cast<std::uint32_t>(part.vertices.size()));
        if (isNew) {
            const auto& [x, y, z] = positions[index];
            part.vertices.emplace_back(world * math::dvec4{x, y, z, 1.0});
        }
        part.indices.push_back(at->second);
    }
    return part;
}

void write(std::ofstream& out, const void* data, std::size_t bytes) {
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
}

}  // namespace

void writePeerScene(const std::filesystem::path& file, const scene::FlatScene& flat) {
    std::ofstream out{file, std::ios::binary};
    std::uint32_t count = 0;
    write(out, &count, sizeof count);
    for (const auto& instance : flat.instances()) {
        const auto* phong = dynamic_cast<const scene::PhongMaterial*>(instance.material);
        if (phong != nullptr && phong->alpha == scene::PhongMaterial::Alpha::blend) continue;
        if (instance.geometry->primitive != scene::Primitive::triangles) continue;
        for (const scene::Chunk& chunk : instance.geometry->chunks) {
            const Part part = partOf(flat, instance, chunk);
            const auto vertices = static_cast<std::uint32_t>(part.vertices.size());
            const auto indices = static_cast<std::uint32_t>(part.indices.size());
            write(out, &vertices, sizeof vertices);
            write(out, &indices, sizeof indices);
            write(out, part.vertices.data(), part.vertices.size() * sizeof(math::vec3));
            write(out, part.indices.data(), part.indices.size() * sizeof(std::uint32_t));
            ++count;
        }
    }
    out.seekp(0);
    write(out, &count, sizeof count);
    out.close();
    if (!out) throw Failure{Errc::file, "cannot write " + file.string()};
}

}  // namespace gnomon::client
