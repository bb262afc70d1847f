#include <fmt/format.h>
#include <gnomon/demo/Export.h>

#include <glm/matrix.hpp>
#include <iterator>

namespace gnomon::demo {

std::string toObj(const Scene& scene) {
    std::string text;
    auto out = std::back_inserter(text);
    const std::vector<glm::mat4> worldFromNode = worldMatrices(scene);
    std::size_t first = 1;  // OBJ counts from 1
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (!node.mesh) continue;
        for (const Primitive& part : scene.meshes[*node.mesh].primitives) {
            // Positions only: vertices that differ in normal or texture become one.
            Mesh bare = part.mesh;
            for (Vertex& v : bare.vertices) v = Vertex{.position = v.position};
            bare = welded(bare);
            for (const Vertex& v : bare.vertices) {
                const glm::vec4 p = worldFromNode[i] * glm::vec4{v.position, 1.0F};
                fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
            }
            const bool mirrored = glm::determinant(glm::mat3{worldFromNode[i]}) < 0.0F;
            for (std::size_t k = 0; k + 2 < bare.indices.size(); k += 3) {
                fmt::format_to(out, "f {} {} {}\n", first + bare.indices[k],
                               first + bare.indices[mirrored ? k + 2 : k + 1],
                               first + bare.indices[mirrored ? k + 1 : k + 2]);
            }
            first += bare.vertices.size();
        }
    }
    return text;
}

}  // namespace gnomon::demo
