#include "ply/PlyHeader.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "input/Report.h"
#include "input/Text.h"

namespace gnomon::importer {
namespace {

constexpr std::size_t maxHeaderLines = 1000;

std::optional<PlyType> typeNamed(std::string_view name) {
    static constexpr auto names = std::to_array<std::pair<std::string_view, PlyType>>({
        {"char", PlyType::i8},
        {"int8", PlyType::i8},
        {"uchar", PlyType::u8},
        {"uint8", PlyType::u8},
        {"short", PlyType::i16},
        {"int16", PlyType::i16},
        {"ushort", PlyType::u16},
        {"uint16", PlyType::u16},
        {"int", PlyType::i32},
        {"int32", PlyType::i32},
        {"uint", PlyType::u32},
        {"uint32", PlyType::u32},
        {"float", PlyType::f32},
        {"float32", PlyType::f32},
        {"double", PlyType::f64},
        {"float64", PlyType::f64},
    });
    for (const auto& [text, type] : names)
        if (text == name) return type;
    return {};
}

class HeaderParser {
public:
    explicit HeaderParser(std::string_view file) : file_{file} {}

    PlyHeader parse() {
        if (file_.substr(0, 3) != "ply")
            refuse(file_.empty() ? "the file is empty, expected PLY"
                                 : "does not begin with \"ply\"; it is no PLY file");
        bool hasFormat = false;
        for (std::size_t number = 1;; ++number) {
            const auto end = file_.find('\n', header_.bytes);
            if (end == std::string_view::npos || number > maxHeaderLines)
                refuse(fmt::format("header: no end_header in its first {} lines", number));
            std::string_view line = trimmed(file_.substr(header_.bytes, end - header_.bytes));
            header_.bytes = end + 1;
            number_ = number;
            const auto keyword = nextToken(line);
            if (keyword == "end_header") break;
            if (keyword == "format") {
                readFormat(nextToken(line));
                hasFormat = true;
            }
            if (keyword == "element") readElement(line);
            if (keyword == "property") readProperty(line);
            if (keyword == "comment" && nextToken(line) == "TextureFile")
                header_.texture = trimmed(line);
        }
        if (!hasFormat) refuse("header: there is no format line");
        return std::move(header_);
    }

private:
    [[noreturn]] void wrong(const std::string& what) const {
        refuse(fmt::format("header line {}: {}", number_, what));
    }
    PlyType typeOf(std::string_view name) const {
        const auto type = typeNamed(name);
        if (!type) wrong(fmt::format("\"{}\" is no type of PLY", printable(name, 40)));
        return *type;
    }
    void readFormat(std::string_view name) {
        if (name == "ascii")
            header_.format = PlyHeader::Format::ascii;
        else if (name == "binary_little_endian")
            header_.format = PlyHeader::Format::littleEndian;
        else if (name == "binary_big_endian")
            header_.format = PlyHeader::Format::bigEndian;
        else
            wrong(fmt::format("format \"{}\" is not known", printable(name, 40)));
    }
    void readElement(std::string_view line) {
        const auto name = nextToken(line);
        const auto text = nextToken(line);
        const auto count = parsedInteger(text);
        if (!count || *count < 0)
            wrong(fmt::format("element {}: count is \"{}\", expected a whole number >= 0",
                              printable(name, 40), printable(text, 40)));
        header_.elements.push_back(
            {.name = std::string{name}, .count = static_cast<std::uint64_t>(*count)});
    }
    void readProperty(std::string_view line) {
        if (header_.elements.empty()) wrong("a property before the first element");
        PlyProperty property;
        auto type = nextToken(line);
        if (type == "list") {
            property.isList = true;
            property.countType = typeOf(nextToken(line));
            if (property.countType == PlyType::f32 || property.countType == PlyType::f64)
                wrong("a list whose count is no whole number");
            type = nextToken(line);
        }
        property.type = typeOf(type);
        property.name = nextToken(line);
        header_.elements.back().properties.push_back(std::move(property));
    }

    std::string_view file_;
    PlyHeader header_;
    std::size_t number_ = 0;
};

}  // namespace

std::size_t bytesOf(PlyType type) noexcept {
    switch (type) {
        case PlyType::i8:
        case PlyType::u8:
            return 1;
        case PlyType::i16:
        case PlyType::u16:
            return 2;
        case PlyType::f64:
            return 8;
        default:
            return 4;
    }
}

std::uint64_t PlyElement::leastBytes(bool ascii) const noexcept {
    std::uint64_t total = 0;
    for (const auto& property : properties) {
        if (ascii)
            total += 2;  // a digit and what separates it
        else
            total += bytesOf(property.isList ? property.countType : property.type);
    }
    return total;
}

PlyHeader parsedPlyHeader(std::string_view file) {
    PlyHeader header = HeaderParser{file}.parse();
    // The last value of a text needs nothing to separate it from the next.
    const std::uint64_t left = file.size() - header.bytes + 1;
    std::uint64_t needed = 0;
    for (const auto& element : header.elements) {
        const auto least = element.leastBytes(header.format == PlyHeader::Format::ascii);
        if (least > 0 && element.count > (left - needed) / least)
            refuse(
                fmt::format("header: {} elements \"{}\" of at least {} bytes, but {} bytes follow",
                            element.count, printable(element.name, 40), least, left - 1));
        needed += element.count * least;
    }
    return header;
}

}  // namespace gnomon::importer
