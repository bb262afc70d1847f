#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::importer {

/// A whole token as a number, C locale; "nan", "inf" and what overflows to infinity included.
/// Nothing where any of it is no part of a number.
std::optional<double> parsedNumber(std::string_view token);
std::optional<std::int64_t> parsedInteger(std::string_view token);

/// Takes the next token off @p text, which is separated by blanks; empty at its end.
inline std::string_view nextToken(std::string_view& text) {
    constexpr std::string_view blanks = " \t\r\v\f";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) {
        text = {};
        return {};
    }
    text.remove_prefix(first);
    const auto token = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(token.size());
    return token;
}

/// Without blanks at either end.
std::string_view trimmed(std::string_view text);

/// Goes through a text line by line. A backslash before a line's end continues it on the next.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_{text} {}
    /// The next line without its end; false at the end of the text.
    bool next(std::string_view& line);
    /// Number of the last line returned, from 1 (of its first part where it was continued).
    std::size_t number() const noexcept { return number_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
    std::size_t ends_ = 0;
    std::string joined_;  // of continued lines
};

}  // namespace gnomon::importer
