#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "Model.h"

namespace gnomon::importer {
namespace {

std::string header(const std::string& vertices, const std::string& faces,
                   const std::string& format = "ascii") {
    return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string three = "0 0 0\n1 0 0\n0 1 0\n";

template <class T>
void put(std::string& to, T value, bool big) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof raw);
    if (big) std::reverse(std::begin(raw), std::end(raw));
    to.append(raw, sizeof raw);
}

TEST(Ply, ReadsAscii) {
    const Model model{"a.ply", header("4", "1") + three + "1 1 0\n4 0 1 3 2"};
    EXPECT_EQ(model.imported().trianglesDrawn, 2U);
    EXPECT_EQ(faultsOf(*model.all<scene::Geometry>().front()), "");
}

TEST(Ply, ReadsBothByteOrders) {
    for (const bool big : {false, true}) {
        auto text = header("3", "1", big ? "binary_big_endian" : "binary_little_endian");
        for (const float v : {0.0F, 0.0F, 0.0F, 7.0F, 0.0F, 0.0F, 0.0F, 5.0F, 0.0F})
            put(text, v, big);
        text += '\3';
        for (const std::int32_t v : {0, 1, 2}) put(text, v, big);
        const Model model{"a.ply", text};
        EXPECT_EQ(model.imported().trianglesDrawn, 1U);
        EXPECT_EQ(model.imported().boundsMax.get(), (math::dvec3{7, 5, 0}));
    }
}

TEST(Ply, ReadsOtherPropertiesColorsAndStrips) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty "
        "double z\n"
        "property list uchar int neighbours\nproperty uchar red\nproperty uchar green\nproperty "
        "uchar blue\n"
        "property float nx\nproperty float ny\nproperty float nz\nelement other 1\nproperty int n\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0 2 5 6 255 0 0 0 0 1\n1 0 0 0 0 255 0 0 0 1\n0 1 0 0 0 0 255 0 0 1\n1 1 0 0 1 1 1 0 "
        "0 1\n"
        "99\n8 0 1 2 3 -1 0 1 2\n";
    const Model model{"a.ply", text};
    EXPECT_EQ(model.imported().trianglesDrawn, 3U);
    const auto& g = *model.all<scene::Geometry>().front();
    EXPECT_EQ(faultsOf(g), "");
    EXPECT_EQ(vectors<math::vec3>(g.positions).size(), 4U);
    for (const auto& n : vectors<math::vec3>(g.normals)) EXPECT_EQ(n, (math::vec3{0, 0, 1}));
    EXPECT_EQ(g.colors->as<std::uint8_t>()[0], 255);
}

TEST(Ply, ShowsVerticesWithoutFacesAsPoints) {
    const Model model{"a.ply", header("3", "0") + three};
    const auto& g = *model.all<scene::Geometry>().front();
    EXPECT_EQ(g.primitive, scene::Primitive::points);
    EXPECT_EQ(g.indices->as<std::uint32_t>().size(), 3U);
}

TEST(Ply, LeavesOutFacesOfVerticesThatDoNotExist) {
    const Model model{"a.ply", header("3", "3") + three + "3 0 1 77\n3 -1 0 1\n3 0 1 2\n"};
    EXPECT_EQ(model.imported().trianglesDrawn, 1U);
    EXPECT_TRUE(model.warned("2 faces left out"));
}

TEST(Ply, RefusesHeadersWithFaults) {
    const auto refused = [](const std::string& text, const std::string& why) {
        const auto said = refusal("a.ply", text);
        EXPECT_NE(said.find(why), std::string::npos) << said;
    };
    refused("", "empty");
    refused("plough\n", "no PLY file");
    refused("nothing", "no PLY file");
    refused(header("-3", "1") + three, "\"-3\"");
    refused(header("4294967295", "4294967295", "binary_little_endian"),
            "4294967295 elements \"vertex\"");
    refused(header("99999999999999999999", "1"), "expected a whole number");
    refused(header("3", "1", "utf8") + three, "format \"utf8\"");
    std::string endless;
    for (int i = 0; i < 100000; ++i) endless += "ply\nformat ascii 1.0\nelement vertex 3\n";
    refused(endless, "end_header");
    auto text = header("3", "1") + three + "3 0 1 2\n";
    refused(std::string{text}.replace(text.find("float x"), 5, "quad"), "\"quad\" is no type");
    refused(std::string{text}.replace(text.find("float x"), 7, "float w"), "no x, y and z");
}

TEST(Ply, RefusesEveryTruncation) {
    const auto text = header("3", "1") + "0.5 0.25 0.125\n1.5 0.25 0.125\n0.5 7.25 0.125\n3 0 1 2";
    EXPECT_EQ(refusal("a.ply", text), "");
    for (std::size_t size = 0; size < text.size(); ++size) {
        const auto said = refusal("a.ply", text.substr(0, size));
        EXPECT_NE(said, "") << "cut at " << size;
    }
    auto binary = header("3", "2", "binary_little_endian");
    const auto begin = binary.size();
    binary.append(36, '\0');
    for (int face = 0; face < 2; ++face) {
        binary += '\3';
        for (const std::int32_t v : {0, 1, 2}) put(binary, v, false);
    }
    EXPECT_EQ(refusal("a.ply", binary), "");
    for (std::size_t size = begin; size < binary.size(); ++size)
        EXPECT_NE(refusal("a.ply", binary.substr(0, size)), "") << "cut at " << size;
}

TEST(Ply, RefusesListsThatAreLongerThanTheFile) {
    auto text = header("3", "1", "binary_little_endian") + std::string(36, '\0') + "\xff";
    text += std::string(4, '\0');
    EXPECT_NE(refusal("a.ply", text).find("255"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::importer
