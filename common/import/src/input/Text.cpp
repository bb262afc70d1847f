#include "input/Text.h"

#include <charconv>
#include <cstdlib>

namespace gnomon::importer {

std::optional<double> parsedNumber(std::string_view token) {
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    double value = 0.0;
    const char* end = token.data() + token.size();
    const auto [at, ec] = std::from_chars(token.data(), end, value);
    if (at != end || token.empty() || ec == std::errc::invalid_argument) return {};
    // Too large or too small: strtod tells which.
    if (ec == std::errc::result_out_of_range)
        return std::strtod(std::string{token}.c_str(), nullptr);
    return value;
}

std::optional<std::int64_t> parsedInteger(std::string_view token) {
    if (token.size() > 1 && token.front() == '+') token.remove_prefix(1);
    std::int64_t value = 0;
    const char* end = token.data() + token.size();
    const auto [at, ec] = std::from_chars(token.data(), end, value);
    if (at != end || ec != std::errc{}) return {};
    return value;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool Lines::next(std::string_view& line) {
    if (rest_.empty()) return false;
    number_ = ends_ + 1;
    joined_.clear();
    while (true) {
        const auto end = rest_.find('\n');
        std::string_view part = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        ++ends_;
        if (!part.empty() && part.back() == '\r') part.remove_suffix(1);
        const bool continued = !part.empty() && part.back() == '\\' && !rest_.empty();
        if (continued) part.remove_suffix(1);
        if (!continued && joined_.empty()) {
            line = part;
            return true;
        }
        joined_ += part;
        joined_ += ' ';
        if (!continued) {
            line = joined_;
            return true;
        }
    }
}

}  // namespace gnomon::importer
