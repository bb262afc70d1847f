#include <gnomon/scene/Material.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "Model.h"
#include "obj/Mtl.h"
#include "obj/ObjFile.h"

namespace gnomon::importer {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, CutsPolygonsAndCountsTriangles) {
    const Model model{"a.obj", square + "f 1 2 3 4\nf 1 2 3\n"};
    EXPECT_EQ(model.imported().trianglesDrawn, 3U);
    EXPECT_EQ(model.imported().boundsMax.get(), (math::dvec3{1, 1, 0}));
}

TEST(Obj, TakesNegativeNumbersContinuedLinesAndNoFinalLineEnd) {
    const Model model{"a.obj", square + "f -4 \\\n-3 -2\r\nf 1 3 4"};
    EXPECT_EQ(model.imported().trianglesDrawn, 2U);
    EXPECT_TRUE(model.warnings().empty());
}

TEST(Obj, TurnsTextureCoordinatesOver) {
    const Model model{"a.obj", square + "vt 0.25 0.125\nf 1/1 2/1 3/1\n"};
    const auto& g = *model.all<scene::Geometry>().front();
    EXPECT_EQ(g.texCoords->as<float>()[0], 0.25F);
    EXPECT_EQ(g.texCoords->as<float>()[1], 0.875F);
}

TEST(Obj, MakesACubeOfEightCornersClosedWithCreasedNormals) {
    const auto box = cube();
    std::string text;
    for (const auto& p : box.positions)
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                "\n";
    for (std::size_t i = 0; i < box.indices.size(); i += 3)
        text += "f " + std::to_string(box.indices[i] + 1) + " " +
                std::to_string(box.indices[i + 1] + 1) + " " +
                std::to_string(box.indices[i + 2] + 1) + "\n";
    const Model model{"a.obj", text};
    const auto& g = *model.all<scene::Geometry>().front();
    EXPECT_EQ(faultsOf(g), "");
    EXPECT_EQ(vectors<math::vec3>(g.positions).size(), 24U);  // a normal a face
    ASSERT_EQ(g.chunks.size(), 1U);
    EXPECT_TRUE(g.chunks[0].closed);
}

TEST(Obj, KeepsObjectsAndMaterialsApart) {
    const TemporaryFolder folder;
    folder.write("m.mtl",
                 "newmtl a\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 100\nnewmtl b\nKd 0 1 0\nd 0.5\n");
    const auto file =
        folder.write("a.obj", "mtllib m.mtl\n" + square +
                                  "o one\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\no two\nf 1 2 4\n");
    const Model model{file};
    EXPECT_EQ(model.all<scene::Geometry>().size(), 3U);
    EXPECT_EQ(model.nodesNamed("one").size(), 4U);  // two parts, material above geometry
    EXPECT_EQ(model.nodesNamed("two").size(), 2U);
    const auto materials = model.all<scene::PhongMaterial>();
    ASSERT_EQ(materials.size(), 2U);
    const auto* a = materials[materials[0]->diffuse.get().x == 1.0F ? 0 : 1];
    const auto* b = materials[materials[0]->diffuse.get().x == 1.0F ? 1 : 0];
    EXPECT_EQ(a->shininess, 100.0F);
    EXPECT_EQ(a->specular.get(), math::vec3{0.5F});
    EXPECT_EQ(b->diffuse.get(), (math::vec4{0, 1, 0, 0.5F}));
    EXPECT_EQ(b->alpha, scene::PhongMaterial::Alpha::blend);
}

TEST(Obj, PutsAMaskIntoTheAlphaOfTheTexture) {
    const TemporaryFolder folder;
    folder.write("tex/a.png", png(2, 1, {0xff0000ffU, 0x00ff00ffU}));
    folder.write("tex/mask.png", png(2, 1, {0xffffffffU, 0x000000ffU}));
    folder.write("m.mtl",
                 "newmtl leaf\nmap_Kd -s 1 1 1 tex\\a.png\nmap_d tex/mask.png\nbump -bm 0.5 "
                 "tex\\mask.png\n");
    const Model model{folder.write(
        "a.obj",
        "mtllib m.mtl\n" + square + "vt 0 0\nvt 1 0\nvt 1 1\nusemtl leaf\nf 1/1 2/2 3/3\n")};
    EXPECT_TRUE(model.warnings().empty());
    const auto& m = *model.all<scene::PhongMaterial>().front();
    // The mask has an alpha channel of its own, which is full: that one counts, and masks nothing.
    EXPECT_EQ(m.alpha, scene::PhongMaterial::Alpha::opaque);
    const auto pixels = model.aspect().get(m.diffuseMap.get())->pixels->as<std::uint8_t>();
    EXPECT_EQ(pixels[3], 255);
    ASSERT_TRUE(m.normalMap.get());
    EXPECT_EQ(model.all<scene::Geometry>().front()->tangents->size(), 3U * 16);
}

TEST(Obj, LeavesOutFacesWithFaults) {
    const Model model{
        "a.obj",
        square + "f 1 2 99\nf -9 1 2\nf 0 1 2\nf 1/2/3 2//9 3/\nf ////\nf 1\nf\nf 1 2 3\n"};
    EXPECT_EQ(model.imported().trianglesDrawn, 1U);
    EXPECT_TRUE(model.warned("line 6"));
    EXPECT_TRUE(model.warned("7 faces"));
}

TEST(Obj, DropsTrianglesThatAreNotFinite) {
    const Model model{"a.obj", square + "v nan 0 0\nv 1e999 0 0\nf 1 2 5\nf 1 2 6\nf 1 2 3\n"};
    EXPECT_EQ(model.imported().trianglesDrawn, 1U);
    EXPECT_EQ(model.imported().boundsMax.get(), (math::dvec3{1, 1, 0}));
}

TEST(Obj, ReadsLinesPointsAndVertexColors) {
    const Model model{"a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0\nl 1 2 3\np 1 2\n"};
    const auto all = model.all<scene::Geometry>();
    ASSERT_EQ(all.size(), 2U);
    for (const auto* g : all) {
        EXPECT_EQ(faultsOf(*g), "");
        EXPECT_EQ(g->indices->as<std::uint32_t>().size(),
                  g->primitive == scene::Primitive::lines ? 4U : 2U);
        EXPECT_EQ(g->colors->as<std::uint8_t>()[0], 255);
        EXPECT_EQ(g->colors->as<std::uint8_t>()[1], 0);
    }
    EXPECT_EQ(model.imported().trianglesDrawn, 0U);
}

TEST(Obj, RefusesWhatIsNone) {
    EXPECT_NE(refusal("a.obj", ""), "");
    EXPECT_NE(refusal("a.obj", std::string(65536, '\x93')), "");
    EXPECT_NE(refusal("a.obj", std::string(100, '\0')), "");
    EXPECT_EQ(refusal("a.obj", square + "v 1 3.1+e2 0\n"), "line 5: v: \"3.1+e2\" is not a number");
    EXPECT_EQ(refusal("a.obj", square + "v 1 2\n"), "line 5: v: 2 numbers, expected 3");
    std::string corners;
    for (int i = 0; i < 20000; ++i) corners += " 1";
    EXPECT_NE(refusal("a.obj", square + "f" + corners + "\n").find("20000 corners"),
              std::string::npos);
}

TEST(Obj, ReadsNoLibraryOutsideItsFolder) {
    const Model model{"a.obj",
                      "mtllib ../../../../../../etc/passwd\n" + square + "usemtl root\nf 1 2 3\n"};
    EXPECT_TRUE(model.warned("only files below the model's folder"));
    EXPECT_TRUE(model.warned("\"root\" is not defined"));
    EXPECT_EQ(model.imported().trianglesDrawn, 1U);
}

TEST(Obj, TakesALineOfTwoMegabytes) {
    const Model model{"a.obj", square + "f 1 2 3\n# " + std::string(2000000, 'A') + "\nv " +
                                   std::string(100000, '9') + " 0 0\nf 1 2 5\n"};
    EXPECT_EQ(model.imported().trianglesDrawn, 1U);
}

TEST(Mtl, SkipsTheOptionsOfMaps) {
    MtlLibrary library;
    Report report;
    parseMtl(
        "newmtl m\nmap_Kd -clamp on -o 0.1 0.2 -blendu off my picture.png\nmap_Bump -bm 0.3 b.png\n"
        "map_Kd2 x\nNs abc\nKd 0.5\n",
        "m.mtl", library, report);
    const auto& m = library.find("m")->second;
    EXPECT_EQ(m.diffuseMap, "my picture.png");
    EXPECT_EQ(m.bumpMap, "b.png");
    EXPECT_EQ(m.bumpScale, 0.3);
    EXPECT_EQ(m.diffuse, math::dvec3{0.5});
    EXPECT_EQ(report.warnings().size(), 1U);
}

}  // namespace
}  // namespace gnomon::importer
