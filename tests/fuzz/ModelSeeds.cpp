#include <gnomon/scene/Types.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>

#include "Model.h"
#include "Seeds.h"
#include "gltf/Gltf.h"
#include "image/Image.h"
#include "input/Uri.h"
#include "program/Send.h"

namespace gnomon::fuzz {
namespace {

using importer::GltfWriter;

// As fuzz-model numbers its readers.
constexpr std::size_t gltf = 0, obj = 1, ply = 2, mtl = 3, image = 4;

/// A few pixels each.
constexpr std::string_view bmp =
    "Qk06AAAAAAAAADYAAAAoAAAAAQAAAAEAAAABABgAAAAAAAQAAAATCwAAEwsAAAAAAAAAAAAAAAD/AA==";
constexpr std::string_view tga = "AAACAAAAAAAAAAAAAQABABgAAAD/";

std::span<const std::byte> raw(const std::string& text) { return std::as_bytes(std::span{text}); }

std::string everythingGltf(bool binary) {
    GltfWriter to;
    const auto shape = importer::sphere(4, 3);
    const auto mesh = to.mesh(shape);
    to.json["images"] = {{{"uri", "data:image/bmp;base64," + std::string{bmp}}}};
    to.json["textures"] = {{{"source", 0}}};
    to.json["materials"] = {{{"pbrMetallicRoughness",
                              {{"baseColorFactor", {1, 0.5, 0.2, 1}},
                               {"baseColorTexture", {{"index", 0}}},
                               {"metallicFactor", 0.5}}},
                             {"alphaMode", "MASK"},
                             {"doubleSided", true}}};
    to.json["meshes"][mesh]["primitives"][0]["material"] = 0;
    to.json["extensionsUsed"] = {"KHR_lights_punctual"};
    to.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 100}, {"spot", {{"outerConeAngle", 0.5}}}},
        {{"type", "directional"}}};
    to.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    const auto child = to.node({{"mesh", mesh}, {"rotation", {0, 0, 0, 1}}});
    to.node({{"children", {child}},
             {"translation", {1, 2, 3}},
             {"camera", 0},
             {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const auto times = to.accessor(std::vector<float>{0, 1}, 5126, "SCALAR");
    const auto places = to.accessor(std::vector<math::vec3>{{0, 0, 0}, {1, 0, 0}}, 5126, "VEC3");
    to.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", child}, {"path", "translation"}}}}}}}};
    return binary ? to.glb() : to.gltf();
}

std::string binaryPly() {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    const auto put = [&](auto value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (const float v : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(v);
    put(std::uint8_t{3});
    for (const int v : {0, 1, 2}) put(v);
    return text;
}

/// What the importer writes of a small scene.
std::vector<std::byte> importerStream() {
    field::TypeRegistry types;
    scene::addTypes(types);
    importer::Report report;
    importer::SceneBuilder scene{types, report};
    const std::string model = everythingGltf(true);
    importer::Folder folder{"/nonexistent/model"};
    importer::readGltf(raw(model), folder, scene);
    const auto list = scene.finish("model.glb");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::tmpfile(), &std::fclose};
    orThrow(importer::send(list, types, ::fileno(file.get())));
    std::vector<std::byte> bytes(
        static_cast<std::size_t>(::lseek(::fileno(file.get()), 0, SEEK_END)));
    if (::pread(::fileno(file.get()), bytes.data(), bytes.size(), 0) !=
        static_cast<ssize_t>(bytes.size()))
        throw Failure{Errc::file, "cannot read a temporary file"};
    return bytes;
}

}  // namespace

void addModelSeeds(const Seeds& seeds) {
    seeds.add("model", "sphere.glb", gltf, raw(everythingGltf(true)));
    seeds.add("model", "sphere.gltf", gltf, raw(everythingGltf(false)));
    GltfWriter cube;
    cube.node({{"mesh", cube.mesh(importer::cube())}});
    seeds.add("model", "cube.glb", gltf, raw(cube.glb()));
    seeds.add("model", "square.obj", obj,
              raw("mtllib a.mtl\no square\nusemtl red\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\n"
                  "v 0.5 0.5 1\nvt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1 4/2/1\ns 1\n"
                  "f -1 -2 -3\ng line\nl 1 2 3\np 1\n"));
    seeds.add("model", "text.ply", ply,
              raw("ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\n"
                  "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                  "property uchar green\nproperty uchar blue\nproperty float s\nproperty float t\n"
                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                  "0 0 0 255 0 0 0 0\n1 0 0 0 255 0 1 0\n1 1 0 0 0 255 1 1\n0 1 0 9 9 9 0 1\n"
                  "4 0 1 2 3\n"));
    seeds.add("model", "binary.ply", ply, raw(binaryPly()));
    seeds.add("model", "red.mtl", mtl,
              raw("newmtl red\nKd 1 0 0\nKs 1 1 1\nNs 50\nKe 0 0 0\nd 0.5\nmap_Kd -s 1 1 1 a.png\n"
                  "map_bump -bm 2 b.png\nnorm c.png\nmap_d d.png\n"));
    seeds.add("model", "jpeg", image, raw(importer::jpeg()));
    seeds.add("model", "png", image, raw(importer::png(2, 2, {1, 2, 3, 4})));
    for (const auto& [name, text] : {std::pair{"bmp", bmp}, {"tga", tga}}) {
        const auto bytes = orThrow(importer::base64Decoded(text));
        orThrow(importer::decodedImage(bytes));
        seeds.add("model", name, image, bytes);
    }
    seeds.dictionary("model", {"\"accessors\":",
                               "\"animations\":",
                               "\"bufferViews\":",
                               "\"buffers\":",
                               "\"cameras\":",
                               "\"images\":",
                               "\"materials\":",
                               "\"meshes\":",
                               "\"nodes\":",
                               "\"scenes\":",
                               "\"textures\":",
                               "\"samplers\":",
                               "\"skins\":",
                               "\"sparse\":",
                               "\"count\":",
                               "\"componentType\":",
                               "\"byteOffset\":",
                               "\"byteStride\":",
                               "\"byteLength\":",
                               "\"normalized\":true",
                               "\"primitives\":",
                               "\"attributes\":",
                               "\"mode\":",
                               "\"targets\":",
                               "\"POSITION\":",
                               "\"NORMAL\":",
                               "\"TANGENT\":",
                               "\"TEXCOORD_0\":",
                               "\"COLOR_0\":",
                               "\"children\":",
                               "\"matrix\":",
                               "\"scale\":",
                               "\"extensions\":",
                               "\"extensionsRequired\":",
                               "\"EXT_mesh_gpu_instancing\":",
                               "\"KHR_texture_transform\":",
                               "\"KHR_materials_pbrSpecularGlossiness\":",
                               "\"KHR_materials_unlit\":",
                               "1e308",
                               "-1",
                               "4294967296",
                               "18446744073709551615",
                               "usemtl ",
                               "mtllib ",
                               "v ",
                               "vn ",
                               "vt ",
                               "f ",
                               "element vertex ",
                               "element face ",
                               "element tristrips 1",
                               "property list uchar int ",
                               "property double ",
                               "format binary_big_endian 1.0",
                               "vertex_indices",
                               "end_header"});

    seeds.add("stream", "scene", 0, importerStream());
    const auto stream = importerStream();
    const std::string words = "@progress 0.5 reading\nmodel.glb: refused\n";
    std::vector<std::byte> both{raw(words).begin(), raw(words).end()};
    both.insert(both.end(), stream.begin(), stream.end());
    seeds.add("stream", "with-words", words.size(), both);
}

}  // namespace gnomon::fuzz
