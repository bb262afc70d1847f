#include <gtest/gtest.h>

#include <cstring>

#include "Model.h"

namespace gnomon::importer {
namespace {

using nlohmann::json;

/// A good file, with one change each: what is refused, and that the message says why.
struct Case {
    const char* name = "";
    void (*change)(json& file) = nullptr;
    const char* says = "";
};

json& position(json& file) { return file["accessors"][0]; }
json& indices(json& file) { return file["accessors"][1]; }
json& primitive(json& file) { return file["meshes"][0]["primitives"][0]; }

const Case cases[] = {
    {"viewOverruns", [](json& f) { f["bufferViews"][0]["byteLength"] = 1 << 20; },
     "buffer view 0: bytes 0 to 1048576, but buffer 0 has 240"},
    {"viewOffsetNegative", [](json& f) { f["bufferViews"][0]["byteOffset"] = -64; },
     "byteOffset is -64"},
    {"viewOffsetHuge", [](json& f) { f["bufferViews"][0]["byteOffset"] = 0xfffffffffffffff0U; },
     "byteOffset"},
    {"viewOfNoBuffer", [](json& f) { f["bufferViews"][0]["buffer"] = 3; },
     "buffer is 3, but there are 1 buffers"},
    {"strideOdd", [](json& f) { f["bufferViews"][0]["byteStride"] = 3; }, "byteStride is 3"},
    {"strideZero", [](json& f) { f["bufferViews"][0]["byteStride"] = 0; }, "byteStride is 0"},
    {"strideTooSmall", [](json& f) { f["bufferViews"][0]["byteStride"] = 8; },
     "elements of 12 bytes"},
    {"countTooLarge", [](json& f) { position(f)["count"] = 9; },
     "accessor 0 (POSITION): 9 elements, but buffer view 0 holds 8"},
    {"countHuge", [](json& f) { position(f)["count"] = 4294967295U; },
     "accessor 0 (POSITION): 4294967295 elements"},
    {"countOfNoView",
     [](json& f) {
         position(f).erase("bufferView");
         position(f)["count"] = 2000000000;
     },
     "2000000000 vertices in one primitive"},
    {"countFraction", [](json& f) { position(f)["count"] = 1.5; }, "count is 1.5"},
    {"componentType", [](json& f) { position(f)["componentType"] = 9999; }, "componentType 9999"},
    {"vec9", [](json& f) { position(f)["type"] = "VEC9"; }, "VEC9"},
    {"positionVec2", [](json& f) { position(f)["type"] = "VEC2"; }, "expected type VEC3"},
    {"indicesFloat", [](json& f) { indices(f)["componentType"] = 5126; }, "unsigned integers"},
    {"accessorOffset", [](json& f) { position(f)["byteOffset"] = 8; }, "holds 7"},
    {"noSuchAccessor", [](json& f) { primitive(f)["attributes"]["POSITION"] = 9999; },
     "POSITION is 9999, but there are 2 accessors"},
    {"unequalCounts",
     [](json& f) {
         primitive(f)["attributes"]["NORMAL"] = 2;
         f["accessors"].push_back(position(f));
         f["accessors"][2]["count"] = 7;
     },
     "7 elements, but accessor 0 (POSITION) has 8"},
    {"mode", [](json& f) { primitive(f)["mode"] = 7; }, "mode is 7"},
    {"noSuchMaterial", [](json& f) { primitive(f)["material"] = 0; },
     "material is 0, but there are 0 materials"},
    {"noSuchMesh", [](json& f) { f["nodes"][0]["mesh"] = 1; }, "node 0: mesh is 1"},
    {"sparseIndex",
     [](json& f) {
         position(f)["sparse"] = {
             {"count", 1},
             {"indices", {{"bufferView", 1}, {"byteOffset", 8}, {"componentType", 5125}}},
             {"values", {{"bufferView", 0}}}};
         f["accessors"][0]["count"] = 3;
     },
     "sparse: index 0"},
    {"sparseCount",
     [](json& f) {
         position(f)["sparse"] = {{"count", 1000000000},
                                  {"indices", {{"bufferView", 1}, {"componentType", 5125}}},
                                  {"values", {{"bufferView", 0}}}};
     },
     "1000000000 elements replaced of 8"},
    {"cycle",
     [](json& f) {
         f["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
         f["scenes"] = {{{"nodes", {0}}}};
     },
     "cycle"},
    {"ownChild", [](json& f) { f["nodes"][0]["children"] = {0}; }, "its own child"},
    {"twoParents",
     [](json& f) {
         f["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, json::object()};
     },
     "two parents"},
    {"childTwice",
     [](json& f) {
         f["nodes"] = {{{"children", {1, 1}}}, json::object()};
     },
     "twice"},
    {"noSuchChild", [](json& f) { f["nodes"][0]["children"] = {77}; },
     "node 0: children names 77, but there are 1 nodes"},
    {"noSuchRoot",
     [](json& f) {
         f["scenes"] = {{{"nodes", {5}}}};
     },
     "5"},
    {"noSuchScene",
     [](json& f) {
         f["scenes"] = {{{"nodes", {0}}}};
         f["scene"] = 4;
     },
     "scene is 4"},
    {"matrixTooLarge",
     [](json& f) { f["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e39, 0, 0, 1}; },
     "1e+39 does not fit a float"},
    {"matrixOfFifteen", [](json& f) { f["nodes"][0]["matrix"] = std::vector<int>(15, 1); },
     "expected an array of 16 numbers"},
    {"version", [](json& f) { f["asset"]["version"] = "99.0"; }, "version \"99.0\""},
    {"minVersion", [](json& f) { f["asset"]["minVersion"] = "3.0"; }, "minVersion \"3.0\""},
    {"noAsset", [](json& f) { f.erase("asset"); }, "asset: is missing"},
    {"unknownExtension", [](json& f) { f["extensionsRequired"] = {"EXT_nobody_has"}; },
     "EXT_nobody_has"},
    {"draco", [](json& f) { f["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, "Draco"},
    {"bufferShort", [](json& f) { f["buffers"][0]["byteLength"] = 100000; },
     "byteLength is 100000, but there are 240 bytes"},
    {"bufferMissing", [](json& f) { f["buffers"][0]["uri"] = "does_not_exist.bin"; },
     "\"does_not_exist.bin\""},
    {"bufferTraversal", [](json& f) { f["buffers"][0]["uri"] = "../../etc/passwd"; },
     "only files below"},
    {"bufferAbsolute", [](json& f) { f["buffers"][0]["uri"] = "/etc/passwd"; }, "only files below"},
    {"bufferDevice", [](json& f) { f["buffers"][0]["uri"] = "/dev/zero"; }, "only files below"},
    {"bufferHttp", [](json& f) { f["buffers"][0]["uri"] = "http://127.0.0.1:9/x.bin"; },
     "only data: URIs"},
    {"bufferBase64",
     [](json& f) { f["buffers"][0]["uri"] = "data:application/octet-stream;base64,@@@@"; },
     "base64"},
    {"wrongTypes", [](json& f) { f["accessors"] = "many"; },
     "accessors is \"many\", expected an array"},
    {"nodesOfNumbers",
     [](json& f) {
         f["nodes"] = {1, 2};
     },
     "node 0 is 1, expected an object"},
};

class Refused : public testing::TestWithParam<Case> {};

std::string written(void (*change)(json&)) {
    GltfWriter writer;
    writer.mesh(cube());
    writer.node({{"mesh", 0}});
    auto file = json::parse(writer.gltf());
    if (change != nullptr) change(file);
    return file.dump();
}

TEST_P(Refused, InOneLineThatSaysWhy) {
    const auto said = refusal("a.gltf", written(GetParam().change));
    EXPECT_NE(said.find(GetParam().says), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Gltf, Refused, testing::ValuesIn(cases),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Gltf, TakesTheFileThatTheRefusedOnesAreMadeOf) {
    EXPECT_EQ(refusal("a.gltf", written(nullptr)), "");
}

TEST(Gltf, RefusesAnIndexOutOfRangeByItsAccessor) {
    GltfWriter writer;
    auto shape = cube();
    shape.indices[7] = 65000;
    writer.mesh(shape);
    writer.node({{"mesh", 0}});
    EXPECT_EQ(refusal("a.glb", writer.glb()),
              "accessor 1 (indices): element 7 is 65000, but mesh 0: primitives 0 has 8 vertices");
}

TEST(Gltf, RefusesNodesThatLieTooDeep) {
    GltfWriter writer;
    writer.mesh(cube());
    for (int i = 0; i < 100000; ++i) writer.node({{"children", {i + 1}}});
    writer.node({{"mesh", 0}});
    EXPECT_NE(refusal("a.gltf", writer.gltf()).find("deeper than 1000"), std::string::npos);
}

TEST(Gltf, TakesNodesAsDeepAsItSays) {
    GltfWriter writer;
    writer.mesh(cube());
    for (int i = 0; i < 999; ++i) writer.node({{"children", {i + 1}}});
    writer.node({{"mesh", 0}});
    const Model model{"a.glb", writer.glb()};  // adopt() checks the depth of all nodes
    EXPECT_EQ(model.imported().trianglesDrawn, 12U);
}

TEST(Glb, IsRefusedWhereverItIsCut) {
    GltfWriter writer;
    writer.mesh(cube());
    writer.node({{"mesh", 0}});
    const auto whole = writer.glb();
    EXPECT_EQ(refusal("a.glb", whole), "");
    for (std::size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 13)
        EXPECT_NE(refusal("a.glb", whole.substr(0, size)), "") << size;
}

TEST(Glb, IsRefusedWhereItsLengthsLie) {
    GltfWriter writer;
    writer.mesh(cube());
    writer.node({{"mesh", 0}});
    const auto with = [&](std::size_t at, std::uint32_t value) {
        auto file = writer.glb();
        std::memcpy(file.data() + at, &value, 4);
        return refusal("a.glb", file);
    };
    EXPECT_NE(with(4, 1).find("version 1"), std::string::npos);
    EXPECT_NE(with(8, 0xfffffff0U), "");
    EXPECT_NE(with(8, 3), "");
    EXPECT_NE(with(12, 0x7fffffffU).find("chunk 0: says 2147483647 bytes"), std::string::npos);
    EXPECT_NE(with(16, 0x12345678U), "");
    EXPECT_NE(refusal("a.glb", "\x89PNG\r\n\x1a\n" + std::string(4096, 'x')), "");
}

TEST(Refused, IsAssimpsOwnDump) {
    const auto why = refusal("model.assbin", "ASSIMP.binary-dump." + std::string(600, '\0'));
    EXPECT_NE(why.find("No suitable reader"), std::string::npos) << why;
}

}  // namespace
}  // namespace gnomon::importer
