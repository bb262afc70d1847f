#include <gnomon/base/Error.h>
#include <gnomon/demo/Export.h>

#include <array>
#include <bit>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

namespace gnomon::demo {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

// Values of the glTF 2.0 specification (those of OpenGL).
constexpr int arrayBuffer = 34962;
constexpr int elementArrayBuffer = 34963;
constexpr int unsignedShort = 5123;
constexpr int unsignedInt = 5125;
constexpr int floatType = 5126;

template <int n>
Json array(const glm::vec<n, float>& v) {
    Json json = Json::array();
    for (int i = 0; i < n; ++i) json.push_back(v[i]);
    return json;
}
Json array(const glm::quat& q) { return Json::array({q.x, q.y, q.z, q.w}); }

class Glb {
public:
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "gnomon-demo-scene"}}}};

    /// Appends bytes on a four-byte boundary; returns the buffer view.
    std::size_t view(std::span<const std::uint8_t> bytes, std::optional<int> target = {}) {
        binary_.resize((binary_.size() + 3U) & ~std::size_t{3U});
        Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
        if (target) view["target"] = *target;
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return add("bufferViews", std::move(view));
    }

    template <class T>
    std::size_t accessor(const std::vector<T>& values, const char* type, int component,
                         std::optional<int> target, Json bounds = Json::object()) {
        const auto bytes = std::as_bytes(std::span{values});
        Json accessor = {
            {"bufferView",
             view({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, target)},
            {"componentType", component},
            {"count", values.size()},
            {"type", type}};
        accessor.update(bounds);
        return add("accessors", std::move(accessor));
    }

    std::size_t add(const char* list, Json item) {
        json[list].push_back(std::move(item));
        return json[list].size() - 1;
    }

    std::vector<std::uint8_t> file() {
        binary_.resize((binary_.size() + 3U) & ~std::size_t{3U});
        json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        std::string text = json.dump();
        text.resize((text.size() + 3U) & ~std::size_t{3U}, ' ');
        const std::size_t total = 12 + 8 + text.size() + 8 + binary_.size();
        if (total > std::numeric_limits<std::uint32_t>::max()) {
            throw Failure{Errc::limit, "a GLB file of " + std::to_string(total) +
                                           " bytes, the format's limit is 4 GiB"};
        }
        std::vector<std::uint8_t> out;
        out.reserve(total);
        const auto put = [&](std::initializer_list<std::size_t> words) {
            for (const std::size_t word : words) {
                for (unsigned shift = 0; shift < 32U; shift += 8U) {
                    out.push_back(static_cast<std::uint8_t>((word >> shift) & 0xffU));
                }
            }
        };
        put({0x46546C67U, 2U, total, text.size(), 0x4E4F534AU});  // "glTF", version; "JSON"
        out.insert(out.end(), text.begin(), text.end());
        put({binary_.size(), 0x004E4942U});  // "BIN"
        out.insert(out.end(), binary_.begin(), binary_.end());
        return out;
    }

private:
    std::vector<std::uint8_t> binary_;
};

Json primitive(Glb& glb, const Primitive& part) {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
    for (const Vertex& v : part.mesh.vertices) {
        positions.push_back(v.position);
        normals.push_back(v.normal);
        uvs.push_back(v.uv);
        low = glm::min(low, v.position);
        high = glm::max(high, v.position);
    }
    const auto floats = [&](const auto& values, const char* type, Json bounds = Json::object()) {
        return glb.accessor(values, type, floatType, arrayBuffer, std::move(bounds));
    };
    Json attributes = {
        {"POSITION", floats(positions, "VEC3", {{"min", array(low)}, {"max", array(high)}})},
        {"NORMAL", floats(normals, "VEC3")},
        {"TEXCOORD_0", floats(uvs, "VEC2")}};
    std::size_t indices = 0;
    if (part.mesh.vertices.size() < 65535) {  // 65535 would be a restart index
        const std::vector<std::uint16_t> narrow(part.mesh.indices.begin(), part.mesh.indices.end());
        indices = glb.accessor(narrow, "SCALAR", unsignedShort, elementArrayBuffer);
    } else {
        indices = glb.accessor(part.mesh.indices, "SCALAR", unsignedInt, elementArrayBuffer);
    }
    return {
        {"attributes", std::move(attributes)}, {"indices", indices}, {"material", part.material}};
}

Json material(const Material& m) {
    Json pbr = {{"baseColorFactor", array(m.baseColour)},
                {"metallicFactor", m.metallic},
                {"roughnessFactor", m.roughness}};
    if (m.baseColourImage) pbr["baseColorTexture"] = {{"index", *m.baseColourImage}};
    Json json = {{"name", m.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    if (m.normalImage) {
        json["normalTexture"] = {{"index", *m.normalImage}, {"scale", m.normalScale}};
    }
    if (m.emissive != glm::vec3{0.0F}) json["emissiveFactor"] = array(m.emissive);
    if (m.masked) json.update({{"alphaMode", "MASK"}, {"alphaCutoff", 0.5}});
    if (m.doubleSided) json["doubleSided"] = true;
    return json;
}

Json light(const Light& l) {
    const bool spot = l.kind == Light::Kind::spot;
    Json json = {{"name", l.name},
                 {"type", spot ? "spot" : "directional"},
                 {"color", array(l.colour)},
                 {"intensity", l.intensity}};
    if (l.range) json["range"] = *l.range;
    if (spot) {
        json["spot"] = {{"innerConeAngle", l.innerCone}, {"outerConeAngle", l.outerCone}};
    }
    return json;
}

Json node(const Node& n) {
    Json json = {{"name", n.name}};
    if (n.translation != glm::vec3{0.0F}) json["translation"] = array(n.translation);
    if (n.rotation != glm::quat{1.0F, 0.0F, 0.0F, 0.0F}) json["rotation"] = array(n.rotation);
    if (n.scale != glm::vec3{1.0F}) json["scale"] = array(n.scale);
    if (n.mesh) json["mesh"] = *n.mesh;
    if (n.camera) json["camera"] = *n.camera;
    if (n.light) json["extensions"]["KHR_lights_punctual"]["light"] = *n.light;
    if (!n.children.empty()) json["children"] = n.children;
    return json;
}

void addSpins(Glb& glb, const Scene& scene) {
    if (scene.spins.empty()) return;
    Json animation = {{"name", "motion"}, {"channels", Json::array()}, {"samplers", Json::array()}};
    for (const Spin& spin : scene.spins) {
        std::vector<glm::vec4> rotations;
        for (const glm::quat& q : spin.rotations) rotations.emplace_back(q.x, q.y, q.z, q.w);
        const Json bounds = {{"min", Json::array({spin.seconds.front()})},
                             {"max", Json::array({spin.seconds.back()})}};
        const std::size_t input = glb.accessor(spin.seconds, "SCALAR", floatType, {}, bounds);
        const std::size_t output = glb.accessor(rotations, "VEC4", floatType, {});
        animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                         {"target", {{"node", spin.node}, {"path", "rotation"}}}});
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    }
    glb.add("animations", std::move(animation));
}

}  // namespace

std::vector<std::uint8_t> toGlb(const Scene& scene) {
    Glb glb;
    std::vector<bool> isChild(scene.nodes.size(), false);
    for (const Node& n : scene.nodes) {
        for (const Index child : n.children) isChild[child] = true;
    }
    Json roots = Json::array();
    for (Index i = 0; i < scene.nodes.size(); ++i) {
        if (!isChild[i]) roots.push_back(i);
        glb.add("nodes", node(scene.nodes[i]));
    }
    glb.json["scene"] = 0;
    glb.add("scenes", {{"name", scene.name}, {"nodes", std::move(roots)}});
    for (const MeshObject& mesh : scene.meshes) {
        Json primitives = Json::array();
        for (const Primitive& part : mesh.primitives) primitives.push_back(primitive(glb, part));
        glb.add("meshes", {{"name", mesh.name}, {"primitives", std::move(primitives)}});
    }
    for (const Material& m : scene.materials) glb.add("materials", material(m));
    for (const Camera& c : scene.cameras) {
        glb.add(
            "cameras",
            {{"name", c.name},
             {"type", "perspective"},
             {"perspective",
              {{"yfov", c.yFov}, {"aspectRatio", c.aspect}, {"znear", c.near}, {"zfar", c.far}}}});
    }
    for (const Light& l : scene.lights) {
        glb.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light(l));
    }
    if (!scene.lights.empty()) glb.json["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
    if (!scene.images.empty()) {
        // Linear between mipmaps, repeated.
        glb.add("samplers",
                {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
    }
    for (Index i = 0; i < scene.images.size(); ++i) {
        const std::vector<std::uint8_t> png = encodePng(scene.images[i]);
        glb.add("images", {{"name", scene.images[i].name},
                           {"mimeType", "image/png"},
                           {"bufferView", glb.view(png)}});
        glb.add("textures", {{"sampler", 0}, {"source", i}});
    }
    addSpins(glb, scene);
    return glb.file();
}

}  // namespace gnomon::demo
