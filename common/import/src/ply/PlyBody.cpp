#include "ply/PlyBody.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "input/Report.h"
#include "input/Text.h"

namespace gnomon::importer {
namespace {

template <class T>
double loaded(const std::array<char, 8>& bytes) noexcept {
    T value{};
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
}

}  // namespace

void PlyBody::refuse(const std::string& what) const {
    importer::refuse(fmt::format(
        "{} {}: {}", element_ != nullptr ? printable(element_->name, 40) : "?", number_, what));
}

double PlyBody::binary(PlyType type) {
    const auto size = bytesOf(type);
    if (rest_.size() < size)
        refuse(fmt::format("the file ends within it ({} elements expected)", element_->count));
    std::array<char, 8> bytes{};
    std::copy_n(rest_.begin(), size, bytes.begin());
    rest_.remove_prefix(size);
    if (format_ == PlyHeader::Format::bigEndian)
        std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    switch (type) {
        case PlyType::i8:
            return loaded<std::int8_t>(bytes);
        case PlyType::u8:
            return loaded<std::uint8_t>(bytes);
        case PlyType::i16:
            return loaded<std::int16_t>(bytes);
        case PlyType::u16:
            return loaded<std::uint16_t>(bytes);
        case PlyType::i32:
            return loaded<std::int32_t>(bytes);
        case PlyType::u32:
            return loaded<std::uint32_t>(bytes);
        case PlyType::f32:
            return loaded<float>(bytes);
        default:
            return loaded<double>(bytes);
    }
}

double PlyBody::text() {
    const auto first = rest_.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos)
        refuse(fmt::format("the file ends within it ({} elements expected)", element_->count));
    rest_.remove_prefix(first);
    const auto token = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
    rest_.remove_prefix(token.size());
    const auto value = parsedNumber(token);
    if (!value) refuse(fmt::format("\"{}\" is not a number", printable(token, 40)));
    return *value;
}

double PlyBody::value(PlyType type) {
    return format_ == PlyHeader::Format::ascii ? text() : binary(type);
}

std::size_t PlyBody::listLength(const PlyProperty& property) {
    const double length = value(property.countType);
    const auto itemBytes = format_ == PlyHeader::Format::ascii ? 2 : bytesOf(property.type);
    const auto most = (rest_.size() + 1) / itemBytes;
    if (!(length >= 0.0 && length <= static_cast<double>(most)) || length != std::floor(length))
        refuse(fmt::format("a list of {:g} values, but {} bytes follow", length, rest_.size()));
    return static_cast<std::size_t>(length);
}

}  // namespace gnomon::importer
