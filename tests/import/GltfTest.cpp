#include <gnomon/scene/Light.h>
#include <gnomon/scene/Material.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Model.h"

namespace gnomon::importer {
namespace {

using nlohmann::json;
using scene::Node;

/// One cube mesh, used by the nodes the test adds.
GltfWriter withCube() {
    GltfWriter writer;
    writer.mesh(cube());
    return writer;
}

TEST(Gltf, KeepsTheHierarchyAndComposesTransforms) {
    auto writer = withCube();
    writer.node({{"name", "child"}, {"mesh", 0}, {"scale", {2, 2, 2}}});
    writer.node({{"name", "parent"},
                 {"children", {0}},
                 {"translation", {10, 0, 0}},
                 {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}});
    for (const auto& [name, content] :
         {std::pair{"a.glb", writer.glb()}, std::pair{"a.gltf", writer.gltf()}}) {
        const Model model{name, content};
        EXPECT_EQ(model.imported().trianglesDrawn, 12U);
        EXPECT_EQ(model.node("child").parent().id, model.node("parent").id());
        // The unit cube, doubled, turned a quarter to the left, moved.
        EXPECT_NEAR(glm::length(model.imported().boundsMin.get() - math::dvec3{8, 0, 0}), 0.0,
                    1e-6);
        EXPECT_NEAR(glm::length(model.imported().boundsMax.get() - math::dvec3{10, 2, 2}), 0.0,
                    1e-6);
        EXPECT_TRUE(model.warnings().empty());
    }
}

TEST(Gltf, TakesAMatrixColumnByColumn) {
    auto writer = withCube();
    writer.node(
        {{"name", "n"}, {"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}});
    const Model model{"a.glb", writer.glb()};
    const auto& m = model.core<scene::Transform>(model.node("n")).matrix.get();
    EXPECT_EQ(m.translation, (math::dvec3{5, 6, 7}));
    EXPECT_EQ(m.linear[1], (math::vec3{0, 3, 0}));
}

TEST(Gltf, SharesCoresBetweenAllUsesOfAMesh) {
    auto writer = withCube();
    for (int i = 0; i < 5; ++i) writer.node({{"mesh", 0}, {"translation", {i, 0, 0}}});
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.all<scene::Geometry>().size(), 1U);
    EXPECT_EQ(model.all<scene::MaterialGroup>().size(), 1U);
    EXPECT_EQ(model.all<scene::PhongMaterial>().size(), 1U);
    EXPECT_EQ(model.imported().trianglesDrawn, 60U);
    EXPECT_EQ(faultsOf(*model.all<scene::Geometry>().front()), "");
}

TEST(Gltf, SharesGeometryBetweenMeshesOfTheSameAccessors) {
    auto writer = withCube();
    writer.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
    writer.json["meshes"].push_back(writer.json["meshes"][0]);
    writer.json["meshes"][0]["primitives"][0]["material"] = 0;
    writer.json["meshes"][1]["primitives"][0]["material"] = 1;
    writer.node({{"mesh", 0}});
    writer.node({{"mesh", 1}});
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.all<scene::Geometry>().size(), 1U);
    EXPECT_EQ(model.all<scene::PhongMaterial>().size(), 2U);
}

TEST(Gltf, ShadesFlatWithoutNormals) {
    auto writer = withCube();
    writer.node({{"mesh", 0}});
    const Model model{"a.glb", writer.glb()};
    const auto& geometry = *model.all<scene::Geometry>().front();
    EXPECT_EQ(geometry.normals->size(), 0U);
    EXPECT_TRUE(geometry.chunks[0].closed);
}

TEST(Gltf, ReadsAllModes) {
    GltfWriter writer;
    const std::vector<math::vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    const auto position = writer.positions(five);
    for (int mode = 0; mode <= 6; ++mode) {
        writer.json["meshes"].push_back(
            {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"mode", mode}}}}});
        writer.node({{"mesh", mode}, {"name", "node " + std::to_string(mode)}});
    }
    const Model model{"a.glb", writer.glb()};
    const auto indices = [&](int mode) {
        const auto& holder =
            *model.aspect().get(model.node("node " + std::to_string(mode)).children()[0]);
        const auto& shape = *model.aspect().get(holder.children()[0]);
        const auto& g = model.core<scene::Geometry>(shape);
        EXPECT_EQ(faultsOf(g), "");
        return g.indices->as<std::uint32_t>().size();
    };
    EXPECT_EQ(indices(0), 5U);
    EXPECT_EQ(indices(1), 4U);
    EXPECT_EQ(indices(2), 10U);
    EXPECT_EQ(indices(3), 8U);
    EXPECT_EQ(indices(4), 3U);
    EXPECT_EQ(indices(5), 9U);
    EXPECT_EQ(indices(6), 9U);
    EXPECT_EQ(model.imported().trianglesDrawn, 1U + 3U + 3U);
}

TEST(Gltf, TurnsAllTrianglesOfAStripTheSameWay) {
    GltfWriter writer;
    const auto position = writer.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}});
    writer.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"mode", 5}}}}}};
    writer.node({{"mesh", 0}});
    const Model model{"a.glb", writer.glb()};
    const auto& g = *model.all<scene::Geometry>().front();
    const auto p = vectors<math::vec3>(g.positions);
    const auto i = g.indices->as<std::uint32_t>();
    for (std::size_t t = 0; t < i.size(); t += 3)
        EXPECT_GT(glm::cross(p[i[t + 1]] - p[i[t]], p[i[t + 2]] - p[i[t]]).z, 0.0F);
}

TEST(Gltf, ReadsSparseAccessors) {
    GltfWriter writer;
    const auto base = writer.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto index = writer.accessor(std::vector<std::uint16_t>{2}, 5123, "SCALAR");
    const auto value = writer.positions({{0, 5, 0}});
    writer.json["accessors"][base]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", index}, {"componentType", 5123}}},
        {"values", {{"bufferView", value}}}};
    writer.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", base}}}}}}}};
    writer.node({{"mesh", 0}});
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.imported().boundsMax.get().y, 5.0);
}

TEST(Gltf, ReadsNormalizedIntegersAndColors) {
    GltfWriter writer;
    const auto position = writer.accessor(
        std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0}, 5122, "VEC3", 4);
    writer.json["accessors"][position]["normalized"] = true;
    writer.json["bufferViews"][position]["byteStride"] = 8;
    const auto color =
        writer.accessor(std::vector<float>{1, 0, 0, 0, 0.5F, 0, 0, 0, 2}, 5126, "VEC3", 3);
    writer.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", position}, {"COLOR_0", color}}}}}}}};
    writer.node({{"mesh", 0}});
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.imported().boundsMax.get(), (math::dvec3{1, 1, 0}));
    const auto& g = *model.all<scene::Geometry>().front();
    const auto colors = g.colors->as<std::uint8_t>();
    const std::vector<std::uint8_t> wanted{255, 0, 0, 255, 0, 128, 0, 255, 0, 0, 255, 255};
    EXPECT_EQ((std::vector<std::uint8_t>{colors.begin(), colors.end()}), wanted);
}

TEST(Gltf, HangsContentBelowItsLights) {
    auto writer = withCube();
    writer.json["extensionsUsed"] = {"KHR_lights_punctual"};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 4.0}, {"name", "sun"}},
        {{"type", "point"}, {"intensity", 8.0}, {"color", {1, 0.5, 0}}, {"name", "lamp"}},
        {{"type", "spot"},
         {"intensity", 2.0},
         {"range", 7.0},
         {"name", "torch"},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}}};
    writer.node({{"mesh", 0}, {"name", "box"}});
    for (int i = 0; i < 3; ++i)
        writer.node({{"translation", {0, 5, i}},
                     {"name", "holder " + std::to_string(i)},
                     {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const Model model{"a.glb", writer.glb()};
    ASSERT_EQ(model.imported().lights.size(), 3U);

    // Each light is above the next, and the last one above all content.
    const auto& a = model.aspect();
    const auto* root = a.get(model.imported().root.get());
    ASSERT_NE(root, nullptr);
    const auto* at = root;
    for (const auto& light : model.imported().lights) {
        ASSERT_EQ(at->children().size(), 1U);
        at = a.get(at->children()[0]);
        EXPECT_EQ(at->id(), light.id);
    }
    const Node* up = &model.node("box");
    while (up != nullptr && up != at) up = a.get(up->parent());
    EXPECT_EQ(up, at);

    const auto& sun = model.core<scene::DirectionalLight>(*a.get(model.imported().lights[0]));
    const auto& lamp = model.core<scene::PointLight>(*a.get(model.imported().lights[1]));
    const auto& torch = model.core<scene::SpotLight>(*a.get(model.imported().lights[2]));
    EXPECT_FLOAT_EQ(sun.intensity, 1.0F);
    EXPECT_FLOAT_EQ(lamp.intensity, 2.0F);  // the same factor for all
    EXPECT_FLOAT_EQ(torch.intensity, 0.5F);
    EXPECT_EQ(lamp.attenuation.get(), (math::vec3{0, 0, 1}));
    EXPECT_EQ(lamp.color.get(), (math::vec3{1, 0.5F, 0}));
    EXPECT_FLOAT_EQ(lamp.range, std::sqrt(200.0F));
    EXPECT_FLOAT_EQ(torch.range, 7.0F);
    EXPECT_FLOAT_EQ(torch.outerAngle, 0.4F);
    const auto* beacon = a.get(lamp.beacon.get());
    ASSERT_NE(beacon, nullptr);
    EXPECT_EQ(beacon->parent().id, model.node("holder 1").id());
}

TEST(Gltf, ReadsCamerasAndLeavesOutWhatIsNone) {
    auto writer = withCube();
    writer.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.5}, {"zfar", 80}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.5}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 0}, {"znear", 0}, {"zfar", -1}}}}};
    writer.node({{"mesh", 0}});
    for (int i = 0; i < 4; ++i) writer.node({{"camera", i}, {"translation", {0, 0, 1000}}});
    const Model model{"a.glb", writer.glb()};
    ASSERT_EQ(model.imported().cameras.size(), 2U);
    const auto* given = model.aspect().get(model.imported().cameras[0]);
    const auto* endless = model.aspect().get(model.imported().cameras[1]);
    EXPECT_EQ(given->fovy, 0.7);
    EXPECT_EQ(given->far, 80.0);
    EXPECT_GT(endless->far, 1000.0);
    EXPECT_TRUE(std::isfinite(endless->far.get()));
    EXPECT_EQ(model.warnings().size(), 2U);
}

json animation(std::size_t input, std::size_t output, const char* path, const char* interpolation) {
    return {
        {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
        {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}};
}

TEST(Gltf, ReadsAnimationsWithTheRestingPose) {
    auto writer = withCube();
    writer.node({{"mesh", 0}, {"name", "mover"}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}});
    const auto times = writer.accessor(std::vector<float>{0.0F, 0.5F, 2.0F}, 5126, "SCALAR");
    const auto places = writer.accessor(std::vector<float>(9, 1.0F), 5126, "VEC3", 3);
    const auto turns = writer.accessor(std::vector<float>(36, 0.5F), 5126, "VEC4", 4);
    writer.json["animations"] = {animation(times, places, "translation", "STEP"),
                                 animation(times, turns, "rotation", "CUBICSPLINE")};
    const Model model{"a.glb", writer.glb()};
    ASSERT_EQ(model.imported().animations.size(), 2U);
    ASSERT_EQ(model.imported().poses.size(), 1U);
    const auto* pose = model.aspect().get(model.imported().poses[0]);
    EXPECT_EQ(pose->translation.get(), (math::dvec3{1, 2, 3}));
    EXPECT_EQ(pose->scale.get(), (math::vec3{2, 2, 2}));
    EXPECT_EQ(pose->target->id, model.node("mover").core->id);
    const auto* spin = model.aspect().get(model.imported().animations[1]);
    EXPECT_EQ(spin->duration, 2.0F);
    const auto* channel = model.aspect().get(spin->channels[0]);
    EXPECT_EQ(channel->interpolation, scene::AnimationChannel::Interpolation::cubicSpline);
    EXPECT_EQ(channel->times->as<float>().size(), 3U);
    EXPECT_EQ(channel->values->as<float>().size(), 36U);
}

TEST(Gltf, LeavesOutAnimationChannelsWithFaults) {
    auto writer = withCube();
    writer.node({{"mesh", 0}});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto good = writer.accessor(std::vector<float>{0.0F, 1.0F}, 5126, "SCALAR");
    const auto falling = writer.accessor(std::vector<float>{1.0F, 0.0F}, 5126, "SCALAR");
    const auto equal = writer.accessor(std::vector<float>{1.0F, 1.0F}, 5126, "SCALAR");
    const auto broken = writer.accessor(std::vector<float>{0.0F, nan}, 5126, "SCALAR");
    const auto values = writer.accessor(std::vector<float>(6, 1.0F), 5126, "VEC3", 3);
    const auto badValues = writer.accessor(std::vector<float>(6, nan), 5126, "VEC3", 3);
    writer.json["animations"] = {animation(falling, values, "translation", "LINEAR"),
                                 animation(equal, values, "translation", "LINEAR"),
                                 animation(broken, values, "translation", "LINEAR"),
                                 animation(good, badValues, "scale", "LINEAR"),
                                 animation(good, values, "rotation", "LINEAR"),
                                 animation(good, values, "sideways", "LINEAR"),
                                 animation(good, values, "scale", "CUBICSPLINE"),
                                 animation(999, values, "scale", "LINEAR")};
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.imported().animations.size(), 0U);
    EXPECT_EQ(model.warnings().size(), 8U);
    EXPECT_TRUE(model.warned("ascend"));
}

TEST(Gltf, ReadsInstances) {
    auto writer = withCube();
    writer.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const auto places = writer.positions({{0, 0, 0}, {10, 0, 0}, {0, 0, 20}});
    writer.node({{"mesh", 0},
                 {"extensions",
                  {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.imported().trianglesDrawn, 36U);
    EXPECT_EQ(model.imported().boundsMax.get(), (math::dvec3{11, 1, 21}));
    EXPECT_EQ(model.all<scene::Geometry>().size(), 1U);
}

TEST(Gltf, DrawsNothingForAFileWithoutScene) {
    GltfWriter writer;
    const Model model{"a.gltf", writer.gltf()};
    EXPECT_EQ(model.imported().trianglesDrawn, 0U);
    EXPECT_GT(model.imported().boundsMin.get().x, model.imported().boundsMax.get().x);
}

TEST(Gltf, DrawsOnlyTheDefaultScene) {
    auto writer = withCube();
    writer.node({{"mesh", 0}, {"name", "a"}});
    writer.node({{"mesh", 0}, {"name", "b"}});
    writer.json["scenes"] = {{{"nodes", {0, 1}}}, {{"nodes", {1}}}};
    writer.json["scene"] = 1;
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.imported().trianglesDrawn, 12U);
    EXPECT_TRUE(model.nodesNamed("a").empty());
}

TEST(Gltf, LeavesOutWhatIsPlacedBeyondAllNumbers) {
    auto writer = withCube();
    writer.node({{"mesh", 0}});
    json deep{{"mesh", 0}};
    writer.node({{"mesh", 0}, {"scale", {1e38, 1e38, 1e38}}});
    for (int i = 0; i < 12; ++i)
        writer.node(
            {{"scale", {1e38, 1e38, 1e38}}, {"children", {writer.json["nodes"].size() - 1}}});
    const Model model{"a.glb", writer.glb()};
    EXPECT_EQ(model.imported().trianglesDrawn, 12U);
    EXPECT_TRUE(model.warned("not finite"));
    EXPECT_EQ(model.imported().boundsMax.get(), (math::dvec3{1, 1, 1}));
}

}  // namespace
}  // namespace gnomon::importer
