#include "gltf/Document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "input/Report.h"
#include "input/Uri.h"

namespace gnomon::importer {
namespace {

constexpr std::uint32_t glbMagic = 0x46546c67;   // "glTF"
constexpr std::uint32_t jsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t binChunk = 0x004e4942;   // "BIN\0"

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// What a file may require of its reader. The material extensions only refine what is drawn; those
/// we do not draw are approximated by leaving them out.
constexpr std::array knownExtensions = std::to_array<std::string_view>({
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
});

GltfContainer glbContainer(std::span<const std::byte> file) {
    if (file.size() < 12)
        refuse(fmt::format("GLB header: the file has {} bytes, expected at least 12", file.size()));
    if (const auto version = wordAt(file, 4); version != 2)
        refuse(fmt::format("GLB header: version {}, expected 2", version));
    const std::uint64_t length = wordAt(file, 8);
    if (length > file.size())
        refuse(fmt::format("GLB header: says {} bytes, the file has {}", length, file.size()));
    if (length < 12) refuse(fmt::format("GLB header: says {} bytes, expected at least 12", length));
    const auto whole = file.subspan(0, static_cast<std::size_t>(length));

    GltfContainer container;
    std::size_t number = 0;
    for (std::size_t at = 12; whole.size() - at >= 8; ++number) {
        const std::uint64_t size = wordAt(whole, at);
        const auto kind = wordAt(whole, at + 4);
        at += 8;
        if (size > whole.size() - at)
            refuse(fmt::format("GLB chunk {}: says {} bytes, but {} are left in the file", number,
                               size, whole.size() - at));
        const auto body = whole.subspan(at, static_cast<std::size_t>(size));
        at += body.size();
        if (number == 0 && kind != jsonChunk)
            refuse("GLB chunk 0: is not the JSON chunk that has to come first");
        if (kind == jsonChunk && !container.json) {
            container.json = std::make_shared<const nlohmann::json>(parsedJson(asText(body)));
        } else if (kind == binChunk && !container.binary) {
            container.binary = body;
        }
    }
    if (!container.json) refuse("GLB: there is no JSON chunk");
    return container;
}

}  // namespace

GltfContainer gltfContainer(std::span<const std::byte> file) {
    if (file.size() >= 4 && wordAt(file, 0) == glbMagic) return glbContainer(file);
    const auto text = asText(file);
    const auto first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first == std::string_view::npos || text[first] != '{')
        refuse(text.empty() ? "the file is empty, expected glTF"
                            : "is neither GLB (it does not begin with \"glTF\") nor JSON");
    return {.json = std::make_shared<const nlohmann::json>(parsedJson(text))};
}

GltfDocument::GltfDocument(std::span<const std::byte> file, Folder& folder)
    : folder_{folder}, container_{gltfContainer(file)}, root_{*container_.json, ""} {
    checkVersion();
    checkExtensions();
    accessors_ = root_.objects("accessors", "accessor");
    meshes_ = root_.objects("meshes", "mesh");
    nodes_ = root_.objects("nodes", "node");
    readBuffers();
    readViews();
}

void GltfDocument::checkVersion() const {
    const auto asset = root_.object("asset");
    if (!asset) refuse("asset: is missing, expected it with a version");
    const auto version = asset->string("version", "");
    const auto minimum = asset->string("minVersion", version);
    if (version.substr(0, 2) != "2." || minimum.substr(0, 2) != "2.")
        refuse(fmt::format(
            "asset: version \"{}\"{}, expected 2.x", printable(version),
            minimum != version ? fmt::format(" (minVersion \"{}\")", printable(minimum)) : ""));
}

void GltfDocument::checkExtensions() const {
    std::string unknown;
    for (const auto& name : root_.strings("extensionsRequired")) {
        if (name == "KHR_draco_mesh_compression")
            refuse(
                "requires KHR_draco_mesh_compression: Draco-compressed meshes are not read; "
                "decompress the file first (gltf-transform copy IN OUT)");
        if (std::find(knownExtensions.begin(), knownExtensions.end(), name) !=
            knownExtensions.end())
            continue;
        unknown += (unknown.empty() ? "" : ", ") + printable(name, 60);
        if (unknown.size() > 300) break;
    }
    if (!unknown.empty())
        refuse("extensionsRequired: " + unknown + " is required, but not known here");
}

void GltfDocument::readBuffers() {
    const auto buffers = root_.objects("buffers", "buffer");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const JsonView& buffer = buffers[i];
        const auto declared = buffer.unsignedInteger("byteLength");
        if (!declared) buffer.refuse("byteLength is missing");
        std::span<const std::byte> bytes;
        if (const auto uri = buffer.string("uri")) {
            auto read = readUri(*uri, folder_);
            if (!read) buffer.refuse(read.error().text());
            owners_.push_back(*read);
            bytes = *owners_.back();
        } else if (i == 0 && container_.binary) {
            bytes = *container_.binary;
        } else {
            // Extensions put their data into buffers like this (EXT_meshopt_compression's
            // fallback); whoever uses it is told that it is empty.
            buffers_.emplace_back();
            continue;
        }
        if (bytes.size() < *declared)
            buffer.refuse(
                fmt::format("byteLength is {}, but there are {} bytes", *declared, bytes.size()));
        buffers_.push_back(bytes.subspan(0, static_cast<std::size_t>(*declared)));
    }
}

void GltfDocument::readViews() {
    for (const JsonView& view : root_.objects("bufferViews", "buffer view")) {
        const auto buffer = view.index("buffer", buffers_.size(), "buffers");
        const auto length = view.unsignedInteger("byteLength");
        const auto offset = view.unsignedInteger("byteOffset", 0);
        const auto stride = view.unsignedInteger("byteStride");
        if (!buffer) view.refuse("buffer is missing");
        if (!length) view.refuse("byteLength is missing");
        if (stride && (*stride < 4 || *stride > 252 || *stride % 4 != 0))
            view.refuse(
                fmt::format("byteStride is {}, expected a multiple of 4 from 4 to 252", *stride));
        const auto whole = buffers_[*buffer];
        if (whole.empty() && *length > 0 && view.extension("EXT_meshopt_compression"))
            view.refuse("is compressed with EXT_meshopt_compression, which is not read");
        // Each is below 2^53, so their sum does not overflow.
        if (offset + *length > whole.size())
            view.refuse(fmt::format("bytes {} to {}, but buffer {} has {}", offset,
                                    offset + *length, *buffer, whole.size()));
        views_.push_back({.bytes = whole.subspan(static_cast<std::size_t>(offset),
                                                 static_cast<std::size_t>(*length)),
                          .stride = static_cast<std::size_t>(stride.value_or(0))});
    }
}

}  // namespace gnomon::importer
