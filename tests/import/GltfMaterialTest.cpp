#include <gnomon/scene/Material.h>
#include <gtest/gtest.h>

#include "Model.h"

namespace gnomon::importer {
namespace {

using nlohmann::json;

class GltfMaterialTest : public testing::Test {
protected:
    /// A textured square with one material; @p image lies beside it as image.png.
    Model read(json material, const std::string& image) {
        GltfWriter writer;
        const auto position = writer.positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
        const auto texCoord =
            writer.accessor(std::vector<float>{0, 1, 1, 1, 1, 0}, 5126, "VEC2", 2);
        writer.json["meshes"] = {
            {{"primitives",
              {{{"attributes", {{"POSITION", position}, {"TEXCOORD_0", texCoord}}},
                {"material", 0}}}}}};
        writer.json["materials"] = {std::move(material)};
        writer.json["images"] = {{{"uri", "image.png"}}};
        writer.json["samplers"] = {
            {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9728}}};
        writer.json["textures"] = {{{"source", 0}}, {{"source", 0}, {"sampler", 0}}};
        writer.node({{"mesh", 0}});
        if (!image.empty()) folder_.write("image.png", image);
        return Model{folder_.write("scene.glb", writer.glb())};
    }
    const TemporaryFolder folder_;
    const std::string red_ = png(2, 2, std::vector<std::uint32_t>(4, 0xff0000ffU));
};

TEST_F(GltfMaterialTest, TurnsMetallicRoughnessIntoPhong) {
    const auto model = read({{"pbrMetallicRoughness",
                              {{"baseColorFactor", {0.8, 0.4, 0.2, 0.5}},
                               {"metallicFactor", 0},
                               {"roughnessFactor", 0.5}}},
                             {"alphaMode", "BLEND"},
                             {"doubleSided", true},
                             {"emissiveFactor", {1, 0.5, 0}},
                             {"extensions",
                              {{"KHR_materials_unlit", json::object()},
                               {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}},
                            red_);
    const auto& m = *model.all<scene::PhongMaterial>().front();
    EXPECT_EQ(m.diffuse.get(), (math::vec4{0.8F, 0.4F, 0.2F, 0.5F}));
    EXPECT_EQ(m.specular.get(), math::vec3{0.04F});
    EXPECT_NEAR(m.shininess, 30.0F, 1e-3F);
    EXPECT_EQ(m.alpha, scene::PhongMaterial::Alpha::blend);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.emissive.get(), (math::vec3{4, 2, 0}));
}

TEST_F(GltfMaterialTest, TakesTheMeanOfAMetallicRoughnessTexture) {
    // Green is roughness, blue metallic: half the texels are metal.
    const auto image = png(2, 1, {0x008000ffU, 0x0080ffffU});
    const auto model =
        read({{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}}, image);
    const auto& m = *model.all<scene::PhongMaterial>().front();
    EXPECT_NEAR(m.specular.get().x, 0.52F, 0.01F);
    EXPECT_NEAR(m.shininess, 29.5F, 1.0F);
    EXPECT_TRUE(model.all<scene::Texture>().empty());
}

TEST_F(GltfMaterialTest, MakesOneTextureForAnImageSamplerAndUse) {
    const auto model = read({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}},
                             {"emissiveTexture", {{"index", 1}}},
                             {"normalTexture", {{"index", 1}, {"scale", 0.5}}}},
                            red_);
    ASSERT_EQ(model.all<scene::Texture>().size(), 2U);
    const auto& m = *model.all<scene::PhongMaterial>().front();
    EXPECT_EQ(m.diffuseMap.get(), m.emissiveMap.get());
    const auto* color = model.aspect().get(m.diffuseMap.get());
    const auto* normal = model.aspect().get(m.normalMap.get());
    EXPECT_TRUE(color->srgb);
    EXPECT_FALSE(normal->srgb);
    EXPECT_EQ(color->pixels.get(), normal->pixels.get());
    EXPECT_EQ(color->size.get(), (glm::ivec2{2, 2}));
    EXPECT_EQ(color->wrapS, scene::Texture::Wrap::clamp);
    EXPECT_EQ(color->wrapT, scene::Texture::Wrap::mirror);
    EXPECT_TRUE(color->nearest);
    EXPECT_FALSE(color->mipmaps);
    EXPECT_EQ(m.normalScale, 0.5F);
    const auto& g = *model.all<scene::Geometry>().front();
    EXPECT_EQ(vectors<math::vec4>(g.tangents).size(), 3U);
}

TEST_F(GltfMaterialTest, AppliesTheTextureTransformAsItsTestModelWants) {
    // The marker of TextureTransformTest: these coordinates have to meet the arrow's tip.
    const auto model = read(
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"extensions", {{"KHR_texture_transform", {{"rotation", 0.39269908169872414}}}}}}}}}},
        red_);
    const auto& m = *model.all<scene::PhongMaterial>().front();
    const math::vec3 marker{0.42095177F, 1.0162675F, 1.0F};
    EXPECT_NEAR(glm::dot(m.texRowS.get(), marker), 0.7778175F, 1e-5F);
    EXPECT_NEAR(glm::dot(m.texRowT.get(), marker), 0.7778175F, 1e-5F);
}

TEST_F(GltfMaterialTest, LeavesASurfaceUntexturedWhoseImageIsMissingOrBroken) {
    const json material{
        {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}};
    for (const std::string& image : {std::string{}, red_.substr(0, 40), png(1, 1, {0U}, 30000U)}) {
        const auto model = read(material, image);
        EXPECT_TRUE(model.all<scene::Texture>().empty());
        EXPECT_TRUE(model.warned("image 0 (image.png)")) << model.warnings().size();
        EXPECT_TRUE(model.warned("left untextured"));
        EXPECT_EQ(model.imported().trianglesDrawn, 1U);
    }
}

}  // namespace
}  // namespace gnomon::importer
