// glTF 2.0. The Khronos Group. ISO/IEC 12113:2022, and the extensions that Document.cpp lists.
#include "gltf/Gltf.h"

#include <fmt/format.h>

#include "gltf/Accessors.h"
#include "gltf/Animations.h"
#include "gltf/Document.h"
#include "gltf/Graph.h"
#include "gltf/Lights.h"
#include "gltf/Materials.h"
#include "gltf/Meshes.h"
#include "gltf/Pose.h"

namespace gnomon::importer {
namespace {

/// Instances of EXT_mesh_gpu_instancing in a file; each is a node of ours.
constexpr std::size_t maxInstances = 200'000;

class GltfReader {
public:
    GltfReader(std::span<const std::byte> file, Folder& folder, SceneBuilder& to)
        : document_{file, folder},
          accessors_{document_},
          materials_{document_, to.aspect(), to.report()},
          meshes_{document_, accessors_, materials_, to.aspect(), to.report()},
          devices_{document_, to.report()},
          to_{to} {}

    void read() {
        const GltfGraph graph = gltfGraph(document_, to_.report());
        to_.useLevels(graph.depth + 3);  // instance, material, geometry
        std::vector<const scene::Node*> made(document_.nodes().size());
        std::vector<math::dmat4> world(document_.nodes().size());
        std::vector<GltfAnimated> animated(document_.nodes().size());
        for (const auto number : graph.order) {
            const JsonView& json = document_.nodes()[number];
            const auto parent = graph.parent[number];
            const bool isRoot = parent == GltfGraph::none;
            GltfAnimated& entry = animated[number];
            entry.pose = gltfPose(json, to_.report());
            const auto& node =
                to_.addTransform(isRoot ? to_.content() : *made[parent],
                                 json.string("name", json.where()), entry.pose.parentFromNode);
            made[number] = &node;
            world[number] = math::toMatrix(entry.pose.parentFromNode);
            if (!isRoot) world[number] = world[parent] * world[number];
            entry.transform = to_.aspect().get(field::Ref<scene::Transform>{node.core.get().id});
            addMesh(json, node, world[number]);
            devices_.add(json, node, world[number], to_);
        }
        addAnimations(document_, accessors_, animated, to_);
    }

private:
    void addMesh(const JsonView& json, const scene::Node& node, const math::dmat4& world) {
        const auto number = json.index("mesh", document_.meshes().size(), "meshes");
        if (!number) return;
        const auto& shapes = meshes_.shapes(*number);
        if (shapes.empty()) return;
        const auto name =
            document_.meshes()[*number].string("name", fmt::format("mesh {}", *number));
        const auto add = [&](const scene::Node& to, const math::dmat4& worldFromTo) {
            for (const GltfShape& shape : shapes)
                to_.addShape(to, name, *shape.geometry, *shape.material, worldFromTo);
        };
        const auto instancing = json.extension("EXT_mesh_gpu_instancing");
        if (!instancing || !addInstances(*instancing, node, world, add)) add(node, world);
    }

    /// One Transform below @p node for each instance. False where there are none to be had.
    template <class Add>
    bool addInstances(const JsonView& json, const scene::Node& node, const math::dmat4& world,
                      Add&& add) {
        const auto attributes = json.object("attributes");
        if (!attributes) return false;
        std::optional<std::size_t> count;
        const auto get = [&](const char* key, std::size_t components) -> std::optional<Accessor> {
            const auto number = attributes->index(key, document_.accessors().size(), "accessors");
            if (!number) return {};
            Accessor accessor = accessors_.get(*number, key);
            if (accessor.components() != components || (count && *count != accessor.count()))
                json.refuse(accessor.where() + ": does not fit the other instance attributes");
            count = accessor.count();
            return accessor;
        };
        const auto translation = get("TRANSLATION", 3);
        const auto rotation = get("ROTATION", 4);
        const auto scale = get("SCALE", 3);
        if (!count) return false;
        instances_ += *count;
        if (instances_ > maxInstances)
            refuseForSize(fmt::format("{}: with it there are {} instances, the limit is {}",
                                      json.where(), instances_, maxInstances));
        for (std::size_t i = 0; i < *count; ++i) {
            math::vec3 t{0.0F};
            math::vec4 q{0.0F, 0.0F, 0.0F, 1.0F};
            math::vec3 s{1.0F};
            if (translation) translation->read(i, std::span{&t.x, 3});
            if (rotation) rotation->read(i, std::span{&q.x, 4});
            if (scale) scale->read(i, std::span{&s.x, 3});
            const math::dvec4 quaternion{q};
            const double length = glm::length(quaternion);
            const math::Affine place{
                .translation = math::dvec3{t},
                .linear = math::mat3{rotationTimesScale(
                    length > 0.0 ? quaternion / length : math::dvec4{0.0, 0.0, 0.0, 1.0},
                    math::dvec3{s})}};
            const auto matrix = math::toMatrix(place);
            if (!math::isFinite(matrix)) {
                to_.report().warn(
                    fmt::format("{}: instance {} is not finite; left out", json.where(), i));
                continue;
            }
            add(to_.addTransform(node, fmt::format("instance {}", i), place), world * matrix);
        }
        return true;
    }

    GltfDocument document_;
    Accessors accessors_;
    GltfMaterials materials_;
    GltfMeshes meshes_;
    GltfDevices devices_;
    SceneBuilder& to_;
    std::size_t instances_ = 0;
};

}  // namespace

void readGltf(std::span<const std::byte> file, Folder& folder, SceneBuilder& to) {
    GltfReader{file, folder, to}.read();
}

}  // namespace gnomon::importer
