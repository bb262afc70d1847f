#include <gnomon/demo/Export.h>
#include <gnomon/demo/Scenes.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace gnomon::demo {
namespace {

using Json = nlohmann::json;

std::uint32_t word(const std::vector<std::uint8_t>& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{bytes.at(at + i)} << (8U * i);
    return value;
}

struct File {
    std::vector<std::uint8_t> bytes = {};
    Json json = {};
    std::size_t binary = 0;  ///< where the binary chunk's data begin
};

File opened(const Scene& scene) {
    File file{.bytes = toGlb(scene)};
    const std::size_t length = word(file.bytes, 12);
    file.json = Json::parse(file.bytes.begin() + 20,
                            file.bytes.begin() + 20 + static_cast<std::ptrdiff_t>(length));
    file.binary = 20 + length + 8;
    return file;
}

TEST(Glb, HasTheContainersHeaderAndTwoWholeChunks) {
    const File file = opened(grove(1));
    EXPECT_EQ(std::memcmp(file.bytes.data(), "glTF", 4), 0);
    EXPECT_EQ(word(file.bytes, 4), 2U);
    EXPECT_EQ(word(file.bytes, 8), file.bytes.size());
    EXPECT_EQ(word(file.bytes, 16), 0x4E4F534AU);
    EXPECT_EQ(word(file.bytes, file.binary - 4), 0x004E4942U);
    const std::size_t binary = word(file.bytes, file.binary - 8);
    EXPECT_EQ(file.binary + binary, file.bytes.size());
    EXPECT_EQ(file.binary % 4, 0U);
    EXPECT_EQ(file.json["buffers"][0]["byteLength"], binary);
}

TEST(Glb, KeepsEveryViewAndAccessorInsideTheBuffer) {
    const File file = opened(plaza(1, 16));
    const std::size_t total = file.json["buffers"][0]["byteLength"];
    const std::map<std::string, std::size_t> parts{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    for (const Json& view : file.json["bufferViews"]) {
        EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(),
                  total);
        EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    }
    for (const Json& accessor : file.json["accessors"]) {
        const std::size_t size = accessor["componentType"] == 5123 ? 2 : 4;
        const Json& view = file.json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
        EXPECT_EQ(accessor["count"].get<std::size_t>() * size * parts.at(accessor["type"]),
                  view["byteLength"].get<std::size_t>());
    }
    for (const Json& image : file.json["images"]) {
        const Json& view = file.json["bufferViews"].at(image["bufferView"].get<std::size_t>());
        const std::size_t at = file.binary + view["byteOffset"].get<std::size_t>();
        EXPECT_EQ(std::memcmp(&file.bytes.at(at), "\x89PNG", 4), 0) << image["name"];
    }
}

TEST(Glb, StoresTheVerticesOfTheScene) {
    const Scene scene = grove(2);
    const File file = opened(scene);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m].primitives[0].mesh;
        const Json& part = file.json["meshes"][m]["primitives"][0];
        const Json& accessor =
            file.json["accessors"].at(part["attributes"]["POSITION"].get<std::size_t>());
        ASSERT_EQ(accessor["count"], mesh.vertices.size());
        const Json& view = file.json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
        const std::size_t at = file.binary + view["byteOffset"].get<std::size_t>();
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            glm::vec3 stored{0.0F};
            std::memcpy(&stored.x, &file.bytes.at(at + v * 12), 12);
            ASSERT_EQ(stored, mesh.vertices[v].position);
            for (std::size_t k = 0; k < 3; ++k) {
                const float value = stored[static_cast<int>(k)];
                ASSERT_GE(value, accessor["min"][k].get<float>());
                ASSERT_LE(value, accessor["max"][k].get<float>());
            }
        }
    }
}

TEST(Glb, WritesEachNodeOnceIntoTheTree) {
    const File file = opened(plaza(1, 16));
    std::map<std::size_t, int> uses;
    for (const Json& root : file.json["scenes"][0]["nodes"]) ++uses[root.get<std::size_t>()];
    for (const Json& node : file.json["nodes"]) {
        if (!node.contains("children")) continue;
        for (const Json& child : node["children"]) ++uses[child.get<std::size_t>()];
    }
    EXPECT_EQ(uses.size(), file.json["nodes"].size());
    for (const auto& [node, count] : uses) EXPECT_EQ(count, 1) << node;
}

TEST(Glb, NamesTheLightsExtensionAndTheViewCamera) {
    const File file = opened(plaza(1, 16));
    EXPECT_EQ(file.json["extensionsUsed"], Json::array({"KHR_lights_punctual"}));
    std::map<std::string, int> kinds;
    for (const Json& light : file.json["extensions"]["KHR_lights_punctual"]["lights"])
        ++kinds[light["type"]];
    EXPECT_EQ(kinds["spot"], 3);
    EXPECT_EQ(kinds["directional"], 1);
    int lit = 0;
    bool hasView = false;
    for (const Json& node : file.json["nodes"]) {
        if (node.contains("extensions")) ++lit;
        hasView = hasView || (node["name"] == "view" && node.contains("camera"));
    }
    EXPECT_EQ(lit, 4);
    EXPECT_TRUE(hasView);
}

}  // namespace
}  // namespace gnomon::demo
