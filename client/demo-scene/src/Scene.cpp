#include <gnomon/base/Error.h>
#include <gnomon/demo/Scene.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace gnomon::demo {
namespace {

template <class T>
Index pushed(std::vector<T>& to, T item) {
    to.push_back(std::move(item));
    return static_cast<Index>(to.size() - 1);
}

}  // namespace

glm::mat4 Node::parentFromNode() const {
    return glm::translate(glm::mat4{1.0F}, translation) * glm::mat4_cast(rotation) *
           glm::scale(glm::mat4{1.0F}, scale);
}

Index Scene::add(Image image) { return pushed(images, std::move(image)); }
Index Scene::add(Material material) { return pushed(materials, std::move(material)); }
Index Scene::add(MeshObject mesh) { return pushed(meshes, std::move(mesh)); }
Index Scene::add(std::string meshName, Mesh mesh, Index material) {
    return add(MeshObject{.name = std::move(meshName),
                          .primitives = {{.mesh = std::move(mesh), .material = material}}});
}
Index Scene::add(Light light) { return pushed(lights, std::move(light)); }
Index Scene::add(Camera camera) { return pushed(cameras, std::move(camera)); }

Index Scene::add(Node node) {
    // Readers that refer to nodes by name (assimp does, for lights and animations) need unique
    // ones.
    const auto taken = [&](const std::string& wanted) {
        return std::any_of(nodes.begin(), nodes.end(),
                           [&](const Node& other) { return other.name == wanted; });
    };
    if (taken(node.name)) {
        int number = 2;
        while (taken(node.name + " " + std::to_string(number))) ++number;
        node.name += " " + std::to_string(number);
    }
    return pushed(nodes, std::move(node));
}

Index Scene::add(Node node, Index parent) {
    GNOMON_EXPECTS(parent < nodes.size(), "a parent is added before its children");
    const Index index = add(std::move(node));
    nodes[parent].children.push_back(index);
    return index;
}

std::size_t trianglesDrawn(const Scene& scene) {
    std::size_t count = 0;
    for (const Node& node : scene.nodes) {
        if (!node.mesh) continue;
        for (const Primitive& p : scene.meshes[*node.mesh].primitives) count += p.mesh.triangles();
    }
    return count;
}

std::vector<glm::mat4> worldMatrices(const Scene& scene) {
    std::vector<glm::mat4> matrices;
    matrices.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) matrices.push_back(node.parentFromNode());
    // Parents come before their children (Scene::add), so one pass in order is enough.
    for (std::size_t parent = 0; parent < scene.nodes.size(); ++parent) {
        for (const Index child : scene.nodes[parent].children) {
            matrices[child] = matrices[parent] * matrices[child];
        }
    }
    return matrices;
}

glm::quat lookingAlong(const glm::vec3& direction) {
    const glm::vec3 back = -glm::normalize(direction);
    const glm::vec3 hint =
        std::abs(back.y) > 0.999F ? glm::vec3{0.0F, 0.0F, -1.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
    const glm::vec3 right = glm::normalize(glm::cross(hint, back));
    return glm::normalize(glm::quat_cast(glm::mat3{right, glm::cross(back, right), back}));
}

}  // namespace gnomon::demo
