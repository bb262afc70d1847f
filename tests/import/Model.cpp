#include "Model.h"

#include <gnomon/scene/Types.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>

#include "build/SceneBuilder.h"
#include "input/Uri.h"
#include "program/ReadModel.h"

namespace gnomon::importer {

TemporaryFolder::TemporaryFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "gnomon-import-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error{"mkdtemp failed"};
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ec;
    std::filesystem::remove_all(path_, ec);
}

std::filesystem::path TemporaryFolder::write(const std::string& name,
                                             std::string_view content) const {
    const auto path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream{path, std::ios::binary} << content;
    return path;
}

std::size_t GltfWriter::accessor(std::span<const std::byte> bytes, std::size_t count,
                                 int componentType, const char* type) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    auto& views = json["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    auto& accessors = json["accessors"];
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", componentType},
                         {"type", type},
                         {"count", count}});
    return accessors.size() - 1;
}

std::size_t GltfWriter::mesh(const Shape& shape) {
    const auto position = positions(shape.positions);
    const auto index = indices(shape.indices);
    json["meshes"].push_back(
        {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"indices", index}}}}});
    return json["meshes"].size() - 1;
}

std::size_t GltfWriter::node(nlohmann::json node) {
    json["nodes"].push_back(std::move(node));
    return json["nodes"].size() - 1;
}

nlohmann::json GltfWriter::finished() {
    auto out = json;
    if (!binary_.empty()) {
        out["buffers"] = {{{"byteLength", binary_.size()}}};
        static constexpr char letters[] =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text = "data:application/octet-stream;base64,";
        for (std::size_t i = 0; i < binary_.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k)
                bits = bits << 8U |
                       (i + k < binary_.size() ? static_cast<unsigned char>(binary_[i + k]) : 0U);
            for (std::size_t k = 0; k < 4; ++k)
                text += i + k <= binary_.size() ? letters[bits >> (18U - 6U * k) & 63U] : '=';
        }
        out["buffers"][0]["uri"] = text;
    }
    return out;
}

std::string GltfWriter::glb() {
    auto out = finished();
    if (out.contains("buffers")) out["buffers"][0].erase("uri");
    std::string text = out.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary = binary_;
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string file;
    const auto word = [&](std::size_t value) {
        const auto w = static_cast<std::uint32_t>(value);
        file.append(reinterpret_cast<const char*>(&w), 4);
    };
    file += "glTF";
    word(2);
    word(12 + 8 + text.size() + 8 + binary.size());
    word(text.size());
    file += "JSON" + text;
    word(binary.size());
    file += std::string{"BIN\0", 4} + binary;
    return file;
}

Model::Model(const std::string& name, std::string_view content) {
    const TemporaryFolder folder;
    load(folder.write(name, content));
}

Model::Model(const std::filesystem::path& file) { load(file); }

Model::Model(const field::ChangeList& list) { adopt(list); }

void Model::load(const std::filesystem::path& file) {
    field::TypeRegistry types;
    scene::addTypes(types);
    Report report;
    SceneBuilder builder{types, report};
    readModel(file, builder);
    adopt(builder.finish(file.filename().string()));
}

void Model::adopt(const field::ChangeList& list) {
    types_ = std::make_unique<field::TypeRegistry>();
    scene::addTypes(*types_);
    aspect_ = std::make_unique<field::Aspect>(*types_, 1);
    orThrow(aspect_->adopt(list));
    const auto found = all<scene::ImportedScene>();
    if (found.size() != 1) throw std::runtime_error{"expected one ImportedScene"};
    imported_ = found.front();
}

std::vector<const scene::Node*> Model::nodesNamed(std::string_view name) const {
    std::vector<const scene::Node*> found;
    for (const auto* node : all<scene::Node>())
        if (node->name.get() == name) found.push_back(node);
    return found;
}

const scene::Node& Model::node(std::string_view name) const {
    const auto found = nodesNamed(name);
    if (found.size() != 1)
        throw std::runtime_error{std::to_string(found.size()) + " nodes are called " +
                                 std::string{name}};
    return *found.front();
}

bool Model::warned(std::string_view text) const {
    for (const auto& warning : imported_->warnings)
        if (warning.find(text) != std::string::npos) return true;
    return false;
}

std::string refusal(const std::string& name, std::string_view content) {
    try {
        const Model model{name, content};
        return {};
    } catch (const Failure& failure) {
        return failure.what();
    }
}

std::string faultsOf(const scene::Geometry& g) {
    const auto positions = vectors<math::vec3>(g.positions);
    const auto indices = g.indices->as<std::uint32_t>();
    const auto normals = vectors<math::vec3>(g.normals);
    const std::size_t corners = g.primitive == scene::Primitive::triangles ? 3
                                : g.primitive == scene::Primitive::lines   ? 2
                                                                           : 1;
    for (const auto& p : positions)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return "a position is not finite";
    if (!normals.empty() && normals.size() != positions.size())
        return "a normal too many or too few";
    for (const auto& n : normals)
        if (!(std::abs(glm::length(n) - 1.0F) < 1e-4F)) return "a normal is no unit vector";
    for (const auto* other : {&g.texCoords.get(), &g.tangents.get(), &g.colors.get()}) {
        const std::size_t size = other == &g.texCoords.get()  ? 8
                                 : other == &g.tangents.get() ? 16
                                                              : 4;
        if (other->size() != 0 && other->size() != positions.size() * size)
            return "an attribute's size";
    }
    std::uint32_t next = 0;
    math::vec3 min{1e38F};
    math::vec3 max{-1e38F};
    for (const auto& chunk : g.chunks) {
        if (chunk.firstIndex != next || chunk.indexCount % corners != 0 || chunk.indexCount == 0)
            return "chunks do not follow one another";
        if (chunk.indexCount > 1024 * corners) return "a chunk is too large";
        next += chunk.indexCount;
        if (next > indices.size()) return "a chunk ends beyond the indices";
        math::vec3 low{1e38F};
        math::vec3 high{-1e38F};
        for (auto i = chunk.firstIndex; i < next; ++i) {
            if (indices[i] >= positions.size()) return "an index is out of range";
            low = glm::min(low, positions[indices[i]]);
            high = glm::max(high, positions[indices[i]]);
        }
        if (low != chunk.min || high != chunk.max) return "a chunk's bounds are not exact";
        min = glm::min(min, low);
        max = glm::max(max, high);
    }
    if (next != indices.size()) return "chunks do not cover all indices";
    if (min != g.boundsMin.get() || max != g.boundsMax.get()) return "the bounds are not exact";
    return {};
}

std::string png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint32_t>& rgba,
                std::uint32_t claimed) {
    const auto big = [](std::uint32_t v) {
        return std::string{static_cast<char>(v >> 24U), static_cast<char>(v >> 16U),
                           static_cast<char>(v >> 8U), static_cast<char>(v)};
    };
    // The reader does not look at checksums.
    const auto chunk = [&](const std::string& kind, const std::string& body) {
        return big(static_cast<std::uint32_t>(body.size())) + kind + body + big(0);
    };
    std::string rows;
    for (std::uint32_t y = 0; y < height; ++y) {
        rows += '\0';  // no filter
        for (std::uint32_t x = 0; x < width; ++x) rows += big(rgba[y * width + x]);
    }
    std::string data = "\x78\x01";
    for (std::size_t at = 0; at < rows.size(); at += 65535) {
        const auto part = rows.substr(at, 65535);
        const auto size = static_cast<std::uint32_t>(part.size());
        data += at + 65535 >= rows.size() ? '\1' : '\0';
        for (const std::uint32_t v : {size, ~size})
            data += std::string{static_cast<char>(v), static_cast<char>(v >> 8U)};
        data += part;
    }
    data += big(0);
    const auto side = [&](std::uint32_t size) { return big(claimed != 0 ? claimed : size); };
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", side(width) + side(height) + std::string{8, 6, 0, 0, 0}) +
           chunk("IDAT", data) + chunk("IEND", "");
}

std::string jpeg() {
    const auto bytes = orThrow(base64Decoded(
        "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDABsSFBcUERsXFhceHBsgKEIrKCUlKFE6PTBCYFVlZF9VXVtqeJmBanGQ"
        "c1tdhbWGkJ6jq62rZ4C8ybqmx5moq6T/2wBDARweHigjKE4rK06kbl1upKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSk"
        "pKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKT/wAARCAABAAIDASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAA"
        "AAP/xAAZEAEAAgMAAAAAAAAAAAAAAAAAAQIDM3L/xAAUAQEAAAAAAAAAAAAAAAAAAAAF/8QAGhEAAgIDAAAAAAAA"
        "AAAAAAAAAAECAzEzcf/aAAwDAQACEQMRAD8Aph005gAQ8gtuyXWf/9k="));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::filesystem::path sharedScenes() {
    const std::filesystem::path path{GNOMON_SOURCE_DIR "/../shared/scenes"};
    std::error_code ec;
    return std::filesystem::is_directory(path, ec) ? path : std::filesystem::path{};
}

}  // namespace gnomon::importer
