#pragma once

#include <gnomon/demo/Image.h>
#include <gnomon/demo/Mesh.h>

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

/// A scene as glTF 2.0 describes one: what the generators make and the exporters write.
/// Right-handed, Y up, metres, radians, linear colours; lights and cameras look along -Z.
namespace gnomon::demo {

/// Place of an object in its vector of the Scene.
using Index = std::uint32_t;

struct Material {
    std::string name = {};
    glm::vec4 baseColour{1.0F};
    std::optional<Index> baseColourImage = {};
    std::optional<Index> normalImage = {};
    float normalScale = 1.0F;
    float metallic = 0.0F;
    float roughness = 0.8F;
    glm::vec3 emissive{0.0F};
    bool masked = false;  ///< alpha below 0.5 is not there
    bool doubleSided = false;
};

struct Primitive {
    Mesh mesh = {};
    Index material = 0;
    bool closed = true;  ///< a set of watertight solids, wound outward
};

struct MeshObject {
    std::string name = {};
    std::vector<Primitive> primitives = {};
};

struct Light {
    enum class Kind : std::uint8_t { directional, spot };

    std::string name = {};
    Kind kind = Kind::directional;
    glm::vec3 colour{1.0F};
    float intensity = 1.0F;           ///< directional: lux; spot: candela
    std::optional<float> range = {};  ///< metres
    float innerCone = 0.3F;           ///< half angle
    float outerCone = 0.6F;           ///< half angle
};

struct Camera {
    std::string name = {};
    float yFov = 0.8F;
    float aspect = 16.0F / 9.0F;
    float near = 0.1F;
    float far = 300.0F;
};

struct Node {
    std::string name = {};
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};
    std::optional<Index> mesh = {};
    std::optional<Index> light = {};
    std::optional<Index> camera = {};
    std::vector<Index> children = {};

    glm::mat4 parentFromNode() const;
};

/// Rotation of one node over time, linear between keys, repeated.
struct Spin {
    Index node = 0;
    std::vector<float> seconds = {};
    std::vector<glm::quat> rotations = {};
};

struct Scene {
    std::string name = {};
    std::vector<Image> images = {};
    std::vector<Material> materials = {};
    std::vector<MeshObject> meshes = {};
    std::vector<Light> lights = {};
    std::vector<Camera> cameras = {};
    std::vector<Node> nodes = {};  ///< those nobody lists as a child are roots
    std::vector<Spin> spins = {};

    Index add(Image image);
    Index add(Material material);
    Index add(MeshObject mesh);
    /// One primitive of closed solids.
    Index add(std::string name, Mesh mesh, Index material);
    Index add(Light light);
    Index add(Camera camera);
    /// A name that is taken gets a number behind it.
    Index add(Node node);
    Index add(Node node, Index parent);
};

/// Triangles of all nodes together, each instance counted.
std::size_t trianglesDrawn(const Scene& scene);

/// World-from-node of every node, in order.
std::vector<glm::mat4> worldMatrices(const Scene& scene);

/// The rotation that turns -Z into @p direction (not zero), with Y up as far as possible.
glm::quat lookingAlong(const glm::vec3& direction);

}  // namespace gnomon::demo
