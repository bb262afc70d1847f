#include "obj/ObjFile.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <span>

#include "build/Phong.h"
#include "input/Text.h"
#include "mesh/Triangulate.h"

namespace gnomon::importer {
namespace {

/// More objects and groups than this are not kept apart: each would be a draw call.
constexpr std::size_t maxParts = 4096;

class ObjParser {
public:
    ObjParser(std::string_view text, Report& report) : text_{text}, report_{report} {}
    ObjFile parse();

private:
    /// A face, line or point as read; corners_ first to last.
    struct Element {
        std::size_t first = 0;
        std::size_t last = 0;
        std::size_t line = 0;
        std::uint32_t part = 0;
        char kind = 'f';
    };

    void readLine(std::string_view line);
    template <std::size_t n>
    std::size_t readNumbers(std::string_view rest, std::size_t least, std::array<double, n>& to);
    void readVertex(std::string_view rest);
    void readElement(std::string_view rest, char kind);
    std::optional<ObjCorner> readCorner(std::string_view token) const;
    std::uint32_t partNow();
    bool inRange(const ObjCorner& corner) const noexcept;
    void finish(const Element& element);
    void leftOut(std::size_t line, std::string_view why);

    std::string_view text_;
    Report& report_;
    Lines lines_{text_};
    std::string_view keyword_;
    ObjFile file_;
    std::vector<ObjCorner> corners_;
    std::vector<Element> elements_;
    std::map<std::pair<std::string, std::string>, std::uint32_t> partNumbers_;
    std::string object_, group_, material_;
    bool hasObjects_ = false;
    std::optional<std::uint32_t> part_;
    std::vector<math::vec3> polygon_;
    std::vector<std::uint32_t> cut_;
    std::size_t faults_ = 0;
};

template <std::size_t n>
std::size_t ObjParser::readNumbers(std::string_view rest, std::size_t least,
                                   std::array<double, n>& to) {
    std::size_t count = 0;
    for (auto token = nextToken(rest); !token.empty() && count < n; token = nextToken(rest)) {
        const auto value = parsedNumber(token);
        if (!value)
            refuse(fmt::format("line {}: {}: \"{}\" is not a number", lines_.number(), keyword_,
                               printable(token, 40)));
        to[count++] = *value;
    }
    if (count < least)
        refuse(fmt::format("line {}: {}: {} numbers, expected {}", lines_.number(), keyword_, count,
                           least));
    return count;
}

void ObjParser::readVertex(std::string_view rest) {
    std::array<double, 6> v{};
    const auto count = readNumbers(rest, 3, v);
    file_.positions.emplace_back(math::dvec3{v[0], v[1], v[2]});
    if (count < 6 && file_.colors.empty()) return;
    file_.colors.resize(file_.positions.size() - 1, Color8{255, 255, 255, 255});
    if (count < 6) v[3] = v[4] = v[5] = 1.0;
    file_.colors.push_back({byteOf(linearFromSrgb(v[3])), byteOf(linearFromSrgb(v[4])),
                            byteOf(linearFromSrgb(v[5])), 255});
}

std::optional<ObjCorner> ObjParser::readCorner(std::string_view token) const {
    ObjCorner corner;
    const std::array<std::uint32_t*, 3> to{&corner.position, &corner.texCoord, &corner.normal};
    const std::array<std::size_t, 3> counts{file_.positions.size(), file_.texCoords.size(),
                                            file_.normals.size()};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto slash = token.find('/');
        const auto number = token.substr(0, slash);
        if (!number.empty()) {
            const auto value = parsedInteger(number);
            if (!value || *value == 0) return {};
            const auto index =
                *value > 0 ? *value - 1 : static_cast<std::int64_t>(counts[i]) + *value;
            if (index < 0 || index >= std::int64_t{ObjCorner::none}) return {};
            *to[i] = static_cast<std::uint32_t>(index);
        } else if (i == 0) {
            return {};
        }
        if (slash == std::string_view::npos) return corner;
        token.remove_prefix(slash + 1);
    }
    return token.empty() ? std::optional{corner} : std::nullopt;
}

std::uint32_t ObjParser::partNow() {
    if (part_) return *part_;
    const std::string& name = hasObjects_ ? object_ : group_;
    const bool crowded = partNumbers_.size() >= maxParts;
    const auto [at, added] =
        partNumbers_.try_emplace({crowded ? std::string{} : name, material_},
                                 static_cast<std::uint32_t>(file_.parts.size()));
    if (added) file_.parts.push_back({.name = at->first.first, .material = material_});
    part_ = at->second;
    return *part_;
}

void ObjParser::leftOut(std::size_t line, std::string_view why) {
    // The first one is named; more are counted.
    if (++faults_ == 1) report_.warn(fmt::format("line {}: {}; left out", line, why));
}

void ObjParser::readElement(std::string_view rest, char kind) {
    Element element{
        .first = corners_.size(), .line = lines_.number(), .part = partNow(), .kind = kind};
    for (auto token = nextToken(rest); !token.empty(); token = nextToken(rest)) {
        const auto corner = readCorner(token);
        if (!corner) {
            corners_.resize(element.first);
            return leftOut(lines_.number(),
                           fmt::format("\"{}\" names no vertex", printable(token, 40)));
        }
        corners_.push_back(*corner);
    }
    element.last = corners_.size();
    elements_.push_back(element);
}

void ObjParser::readLine(std::string_view line) {
    keyword_ = nextToken(line);
    if (keyword_.empty() || keyword_.front() == '#') return;
    if (keyword_ == "v") {
        readVertex(line);
    } else if (keyword_ == "vt") {
        std::array<double, 2> t{};
        readNumbers(line, 1, t);
        file_.texCoords.emplace_back(
            math::dvec2{t[0], 1.0 - t[1]});  // OBJ: v = 0 is the bottom row
    } else if (keyword_ == "vn") {
        std::array<double, 3> n{};
        readNumbers(line, 3, n);
        file_.normals.emplace_back(math::dvec3{n[0], n[1], n[2]});
    } else if (keyword_ == "f" || keyword_ == "fo" || keyword_ == "l" || keyword_ == "p") {
        readElement(line, keyword_.front());
    } else if (keyword_ == "o") {
        // Faces before the first object keep the group they have.
        object_ = trimmed(line);
        hasObjects_ = true;
        part_.reset();
    } else if (keyword_ == "g") {
        group_ = trimmed(line);
        if (!hasObjects_) part_.reset();
    } else if (keyword_ == "usemtl") {
        material_ = trimmed(line);
        part_.reset();
    } else if (keyword_ == "mtllib") {
        file_.libraries.emplace_back(trimmed(line));
    }
}

bool ObjParser::inRange(const ObjCorner& c) const noexcept {
    return c.position < file_.positions.size() &&
           (c.texCoord == ObjCorner::none || c.texCoord < file_.texCoords.size()) &&
           (c.normal == ObjCorner::none || c.normal < file_.normals.size());
}

void ObjParser::finish(const Element& element) {
    const std::span corners =
        std::span{corners_}.subspan(element.first, element.last - element.first);
    for (const auto& corner : corners)
        if (!inRange(corner))
            return leftOut(element.line,
                           "names a vertex, texture coordinate or normal that does "
                           "not exist");
    ObjPart& part = file_.parts[element.part];
    if (element.kind == 'p') {
        part.points.insert(part.points.end(), corners.begin(), corners.end());
        return;
    }
    if (element.kind == 'l') {
        if (corners.size() < 2) return leftOut(element.line, "a line of less than two corners");
        for (std::size_t i = 1; i < corners.size(); ++i)
            part.lines.insert(part.lines.end(), {corners[i - 1], corners[i]});
        return;
    }
    if (corners.size() < 3) return leftOut(element.line, "a face of less than three corners");
    if (corners.size() > maxPolygonCorners)
        refuse(fmt::format("line {}: a face of {} corners, the limit is {}", element.line,
                           corners.size(), maxPolygonCorners));
    polygon_.clear();
    for (const auto& corner : corners) polygon_.push_back(file_.positions[corner.position]);
    cut_.clear();
    triangulate(polygon_, cut_);
    for (const auto i : cut_) part.triangles.push_back(corners[i]);
}

ObjFile ObjParser::parse() {
    std::size_t bytes = 0;
    for (std::string_view line; lines_.next(line); bytes += line.size() + 1) {
        if (lines_.number() % 100000 == 0)
            report_.progress(0.5 * static_cast<double>(bytes) / static_cast<double>(text_.size()),
                             "parsing");
        readLine(line);
    }
    if (file_.positions.empty())
        refuse(text_.empty() ? "the file is empty, expected OBJ text"
                             : "there is no line \"v x y z\"; the file is no OBJ text");
    if (!file_.colors.empty())
        file_.colors.resize(file_.positions.size(), Color8{255, 255, 255, 255});
    for (const Element& element : elements_) finish(element);
    if (faults_ > 1)
        report_.warn(fmt::format("{} faces, lines or points left out in all", faults_));
    if (elements_.empty()) report_.warn("there are vertices, but no faces, lines or points");
    return std::move(file_);
}

}  // namespace

ObjFile parsedObj(std::string_view text, Report& report) { return ObjParser{text, report}.parse(); }

}  // namespace gnomon::importer
