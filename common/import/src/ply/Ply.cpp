// Greg Turk. The PLY Polygon File Format. 1994. Elements "vertex", "face" and "tristrips"; others
// are skipped.
#include "ply/Ply.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "build/Phong.h"
#include "input/Text.h"
#include "mesh/BuildGeometry.h"
#include "mesh/Normals.h"
#include "mesh/Triangulate.h"
#include "obj/ObjMaterials.h"
#include "ply/PlyBody.h"
#include "ply/PlyHeader.h"

namespace gnomon::importer {
namespace {

/// What of a vertex a property is.
enum Role : std::size_t { px, py, pz, nx, ny, nz, tu, tv, red, green, blue, alpha, roles };

std::optional<Role> roleOf(std::string_view name) {
    static constexpr auto names = std::to_array<std::pair<std::string_view, Role>>({
        {"x", px},
        {"y", py},
        {"z", pz},
        {"nx", nx},
        {"ny", ny},
        {"nz", nz},
        {"s", tu},
        {"t", tv},
        {"u", tu},
        {"v", tv},
        {"texture_u", tu},
        {"texture_v", tv},
        {"red", red},
        {"green", green},
        {"blue", blue},
        {"alpha", alpha},
        {"diffuse_red", red},
        {"diffuse_green", green},
        {"diffuse_blue", blue},
        {"r", red},
        {"g", green},
        {"b", blue},
    });
    for (const auto& [text, role] : names)
        if (text == name) return role;
    return {};
}

/// What of a colour's type is full intensity.
double fullOf(PlyType type) noexcept {
    if (type == PlyType::f32 || type == PlyType::f64) return 1.0;
    return type == PlyType::u16 ? 65535.0 : 255.0;
}

class PlyReader {
public:
    PlyReader(std::span<const std::byte> file, Report& report)
        : text_{asText(file)},
          header_{parsedPlyHeader(text_)},
          body_{text_.substr(header_.bytes), header_.format},
          report_{report} {}

    MeshData read() {
        for (const PlyElement& element : header_.elements) {
            report_.progress(
                0.5 * (1.0 - static_cast<double>(body_.left()) / static_cast<double>(text_.size())),
                "parsing " + element.name);
            if (element.properties.empty()) continue;
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face" || element.name == "tristrips")
                readFaces(element);
            else
                skip(element);
        }
        finishFaces();
        return std::move(mesh_);
    }
    const PlyHeader& header() const noexcept { return header_; }

private:
    void readVertices(const PlyElement& element);
    void readFaces(const PlyElement& element);
    void skip(const PlyElement& element);
    void skipList(const PlyProperty& property) {
        for (auto n = body_.listLength(property); n > 0; --n) body_.value(property.type);
    }
    void readList(const PlyElement& element, const PlyProperty& property, std::uint64_t number);
    void finishFaces();
    void addPolygon(std::span<const std::uint32_t> corners);
    void addStrips(std::span<const std::int64_t> items);

    std::string_view text_;
    PlyHeader header_;
    PlyBody body_;
    Report& report_;
    MeshData mesh_;
    bool hasFaces_ = false;
    // Faces may come before vertices: kept as numbers until all is read.
    std::vector<std::int64_t> items_;
    std::vector<std::size_t> ends_;  // of each list in items_
    std::vector<bool> isStrip_;      // each list
    std::vector<math::vec3> polygon_;
    std::vector<std::uint32_t> cut_;
    std::size_t dropped_ = 0;
};

void PlyReader::readVertices(const PlyElement& element) {
    std::array<bool, roles> has{};
    std::vector<std::optional<Role>> roleAt;
    for (const auto& property : element.properties) {
        roleAt.push_back(property.isList ? std::nullopt : roleOf(property.name));
        if (roleAt.back()) has[*roleAt.back()] = true;
    }
    if (!has[px] || !has[py] || !has[pz]) refuse("header: element vertex has no x, y and z");
    const bool normals = has[nx] && has[ny] && has[nz];
    const bool textured = has[tu] && has[tv];
    const bool colored = has[red] && has[green] && has[blue];
    for (std::uint64_t i = 0; i < element.count; ++i) {
        body_.at(element, i);
        std::array<double, roles> v{};
        v[alpha] = 1.0;
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const auto& property = element.properties[p];
            if (property.isList) {
                skipList(property);
                continue;
            }
            const double value = body_.value(property.type);
            if (const auto role = roleAt[p])
                v[*role] = *role >= red ? value / fullOf(property.type) : value;
        }
        mesh_.positions.emplace_back(math::dvec3{v[px], v[py], v[pz]});
        if (normals) mesh_.normals.emplace_back(math::dvec3{v[nx], v[ny], v[nz]});
        // v = 0 is the bottom row, as in the programs that write texture coordinates to PLY.
        if (textured) mesh_.texCoords.emplace_back(math::dvec2{v[tu], 1.0 - v[tv]});
        if (colored)
            mesh_.colors.push_back({byteOf(linearFromSrgb(v[red])),
                                    byteOf(linearFromSrgb(v[green])),
                                    byteOf(linearFromSrgb(v[blue])), byteOf(v[alpha])});
    }
}

void PlyReader::readFaces(const PlyElement& element) {
    hasFaces_ = true;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        body_.at(element, i);
        for (const auto& property : element.properties) {
            if (!property.isList)
                body_.value(property.type);
            else if (property.name == "vertex_indices" || property.name == "vertex_index")
                readList(element, property, i);
            else
                skipList(property);
        }
    }
}

void PlyReader::readList(const PlyElement& element, const PlyProperty& property,
                         std::uint64_t number) {
    const bool strip = element.name == "tristrips";
    const auto length = body_.listLength(property);
    if (!strip && length > maxPolygonCorners)
        body_.refuse(
            fmt::format("a face of {} corners, the limit is {}", length, maxPolygonCorners));
    for (std::size_t k = 0; k < length; ++k) {
        const double value = body_.value(property.type);
        if (!(std::abs(value) <= 4294967295.0) || value != std::floor(value))
            body_.refuse(fmt::format("{:g} is no vertex number", value));
        items_.push_back(static_cast<std::int64_t>(value));
    }
    ends_.push_back(items_.size());
    isStrip_.push_back(strip);
    if (number % 200000 == 0) report_.progress(0.3, "parsing faces");
}

void PlyReader::skip(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
        body_.at(element, i);
        for (const auto& property : element.properties) {
            if (property.isList)
                skipList(property);
            else
                body_.value(property.type);
        }
    }
}

void PlyReader::addPolygon(std::span<const std::uint32_t> corners) {
    polygon_.clear();
    for (const auto v : corners) polygon_.push_back(mesh_.positions[v]);
    cut_.clear();
    triangulate(polygon_, cut_);
    for (const auto i : cut_) mesh_.indices.push_back(corners[i]);
}

void PlyReader::addStrips(std::span<const std::int64_t> items) {
    const auto vertices = static_cast<std::int64_t>(mesh_.positions.size());
    std::size_t first = 0;  // of the present strip; -1 begins another
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i] == -1) first = i + 1;
        if (items[i] < 0 || i < first + 2) continue;
        const bool even = (i - first) % 2 == 0;
        const std::array<std::int64_t, 3> t{items[i - 2], even ? items[i - 1] : items[i],
                                            even ? items[i] : items[i - 1]};
        if (*std::min_element(t.begin(), t.end()) < 0 ||
            *std::max_element(t.begin(), t.end()) >= vertices)
            ++dropped_;
        else
            for (const auto v : t) mesh_.indices.push_back(static_cast<std::uint32_t>(v));
    }
}

void PlyReader::finishFaces() {
    if (mesh_.positions.empty() && !ends_.empty()) refuse("there are faces, but no vertices");
    if (!hasFaces_ || ends_.empty()) {
        mesh_.primitive = scene::Primitive::points;
        mesh_.indices.resize(mesh_.positions.size());
        std::iota(mesh_.indices.begin(), mesh_.indices.end(), 0U);
        return;
    }
    std::size_t first = 0;
    std::vector<std::uint32_t> corners;
    for (std::size_t list = 0; list < ends_.size(); ++list) {
        const auto items = std::span{items_}.subspan(first, ends_[list] - first);
        first = ends_[list];
        if (isStrip_[list]) {
            addStrips(items);
            continue;
        }
        corners.clear();
        for (const auto v : items)
            if (v >= 0 && v < static_cast<std::int64_t>(mesh_.positions.size()))
                corners.push_back(static_cast<std::uint32_t>(v));
        if (corners.size() == items.size() && corners.size() >= 3)
            addPolygon(corners);
        else
            ++dropped_;
    }
    if (dropped_ > 0)
        report_.warn(
            fmt::format("{} faces left out: fewer than three corners, or vertices that do "
                        "not exist ({} do)",
                        dropped_, mesh_.positions.size()));
}

}  // namespace

void readPly(std::span<const std::byte> file, Folder& folder, SceneBuilder& to) {
    PlyReader reader{file, to.report()};
    MeshData mesh = reader.read();
    to.useLevels(2);
    ObjMaterials materials{to.aspect(), folder, to.report()};
    const auto& texture = reader.header().texture;
    const auto& material =
        texture.empty() || mesh.texCoords.empty() ? materials.get("") : materials.textured(texture);
    to.report().progress(0.5, "building");
    if (mesh.primitive == scene::Primitive::triangles && mesh.normals.empty()) {
        auto normals = creasedNormals(mesh.positions, mesh.indices);
        unshareVertices(mesh);
        mesh.normals = std::move(normals);
    }
    const auto* geometry = buildGeometry(to.aspect(), std::move(mesh), false, to.report(), "mesh");
    if (geometry != nullptr)
        to.addShape(to.content(), "mesh", *geometry, material, math::dmat4{1.0});
}

}  // namespace gnomon::importer
