#pragma once

#include <gnomon/config/Config.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Values as TOML writes them: what toToml() emits and what messages quote. Always one line.
namespace gnomon::config {

std::string tomlText(bool value);
std::string tomlText(int value);
/// Shortest digits that read back the same, always with a point or an exponent.
std::string tomlText(double value);
/// Quoted; control characters are escaped.
std::string tomlText(std::string_view value);
inline std::string tomlText(const std::string& value) { return tomlText(std::string_view{value}); }
inline std::string tomlText(Eye value) { return tomlText(name(value)); }
inline std::string tomlText(OnTimeout value) { return tomlText(name(value)); }
inline std::string tomlText(DepthRange value) { return tomlText(name(value)); }
inline std::string tomlText(Launch value) { return tomlText(name(value)); }
inline std::string tomlText(Compress value) { return tomlText(name(value)); }

namespace detail {
std::string bracketed(const std::vector<std::string>& parts);

template <class Range>
std::string tomlList(const Range& values) {
    std::vector<std::string> parts;
    parts.reserve(values.size());
    for (const auto& value : values) parts.push_back(tomlText(value));
    return bracketed(parts);
}
}  // namespace detail

template <std::size_t n>
std::string tomlText(const std::array<int, n>& values) {
    return detail::tomlList(values);
}
template <std::size_t n>
std::string tomlText(const std::array<double, n>& values) {
    return detail::tomlList(values);
}
std::string tomlText(const std::array<Colour, 2>& values);
template <class T>
std::string tomlText(const std::vector<T>& values) {
    return detail::tomlList(values);
}
template <class T>
std::string tomlText(const std::optional<T>& value) {
    return value ? tomlText(*value) : std::string{};
}

/// The word most like @p word, if one is so like it that it was probably meant.
/// Case and the choice between '_' and '-' do not count.
std::optional<std::string_view> nearest(std::string_view word,
                                        std::span<const std::string_view> words);

/// ", did you mean "front"?" or nothing.
std::string suggestion(std::string_view word, std::span<const std::string_view> words);

/// "left", "right" or "mono"
std::string oneOf(std::span<const std::string_view> words);

}  // namespace gnomon::config
