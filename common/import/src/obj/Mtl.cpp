#include "obj/Mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "input/Text.h"

namespace gnomon::importer {
namespace {

std::string lowered(std::string_view text) {
    std::string out{text};
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

/// Values that a map's option takes; -o, -s and -t take one to three.
std::size_t optionValues(std::string_view option) {
    if (option == "-o" || option == "-s" || option == "-t") return 3;
    if (option == "-mm") return 2;
    return 1;
}

struct MapLine {
    std::string file = {};
    double bumpScale = 1.0;
};

/// `-bm 0.5 -s 1 1 1 file name with blanks.png`
MapLine parsedMap(std::string_view rest) {
    MapLine map;
    rest = trimmed(rest);
    while (!rest.empty() && rest.front() == '-') {
        auto after = rest;
        const auto option = nextToken(after);
        const auto most = optionValues(option);
        for (std::size_t i = 0; i < most; ++i) {
            auto further = after;
            const auto value = nextToken(further);
            const auto number = parsedNumber(value);
            const bool wordOption = most == 1 && !number;  // -clamp on, -imfchan r
            if (!number && !wordOption) break;
            if (option == "-bm" && number) map.bumpScale = *number;
            after = further;
        }
        rest = trimmed(after);
    }
    map.file = rest;
    std::replace(map.file.begin(), map.file.end(), '\\', '/');
    return map;
}

}  // namespace

void parseMtl(std::string_view text, const std::string& name, MtlLibrary& to, Report& report) {
    MtlMaterial* material = nullptr;
    Lines lines{text};
    for (std::string_view line; lines.next(line);) {
        const auto keyword = lowered(nextToken(line));
        if (keyword.empty() || keyword.front() == '#') continue;
        if (keyword == "newmtl") {
            material = &to[std::string{trimmed(line)}];
            *material = {};
            continue;
        }
        if (material == nullptr) continue;
        const auto number = [&](double& value) {
            auto rest = line;
            const auto parsed = parsedNumber(nextToken(rest));
            if (parsed)
                value = *parsed;
            else
                report.warn(fmt::format("{}: line {}: {} has no number; left out", name,
                                        lines.number(), keyword));
        };
        const auto color = [&](math::dvec3& value) {
            auto rest = line;
            std::array<std::optional<double>, 3> c;
            for (auto& part : c) part = parsedNumber(nextToken(rest));
            if (c[0]) value = {*c[0], c[1].value_or(*c[0]), c[2].value_or(*c[0])};
        };
        if (keyword == "kd") color(material->diffuse);
        if (keyword == "ks") color(material->specular);
        if (keyword == "ke") color(material->emissive);
        if (keyword == "ns") number(material->shininess);
        if (keyword == "d") number(material->alpha);
        if (keyword == "map_kd") material->diffuseMap = parsedMap(line).file;
        if (keyword == "map_ke") material->emissiveMap = parsedMap(line).file;
        if (keyword == "map_d") material->alphaMap = parsedMap(line).file;
        if (keyword == "norm" || keyword == "map_kn") material->normalMap = parsedMap(line).file;
        if (keyword == "map_bump" || keyword == "bump") {
            const MapLine map = parsedMap(line);
            material->bumpMap = map.file;
            material->bumpScale = map.bumpScale;
        }
    }
}

}  // namespace gnomon::importer
