#include "Precheck.h"

namespace gnomon::config {
namespace {

constexpr int maxKeyParts = 16;

// The text after a string that starts @p text with a quote; TOML's four kinds of string.
std::string_view afterString(std::string_view text) {
    const char quote = text.front();
    const bool escapes = quote == '"';
    const bool isMultiline = text.size() >= 3 && text[1] == quote && text[2] == quote;
    text.remove_prefix(isMultiline ? 3 : 1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (escapes && text[i] == '\\') {
            ++i;
        } else if (text[i] == '\n' && !isMultiline) {
            return text.substr(i);  // not closed: the parser will complain here
        } else if (text[i] == quote) {
            if (!isMultiline) return text.substr(i + 1);
            if (text.substr(i, 3) == std::string_view{quote == '"' ? "\"\"\"" : "'''"}) {
                return text.substr(i + 3);
            }
        }
    }
    return {};
}

Place placeBehind(std::string_view before, std::string_view filename) {
    Place place{.file = std::string{filename}, .line = 1, .column = 1};
    for (const char c : before) {
        place.column = c == '\n' ? 1 : place.column + 1;
        place.line += c == '\n' ? 1 : 0;
    }
    return place;
}

}  // namespace

std::optional<Finding> precheck(std::string_view text, std::string_view filename) {
    constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
    const std::string_view whole = text;
    const auto finding = [&](std::string what) {
        const auto before = whole.substr(0, whole.size() - text.size());
        return Finding{.place = placeBehind(before, filename), .what = std::move(what)};
    };
    int parts = 1;
    while (!text.empty()) {
        const char c = text.front();
        if (c == '"' || c == '\'') {
            text = afterString(text);
            continue;
        }
        if (c == '#') {
            const std::size_t end = text.find('\n');
            text = end == std::string_view::npos ? std::string_view{} : text.substr(end);
            continue;
        }
        if (static_cast<unsigned char>(c) >= 0x80) {
            return finding("not TOML: a character beyond ASCII, allowed in quotes and comments");
        }
        if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') parts = 1;
        if (c == '.' && ++parts > maxKeyParts) {
            return finding(fmt::format(
                "a dotted key of more than {} parts, known keys have at most 4", maxKeyParts));
        }
        text.remove_prefix(1);
    }
    return {};
}

}  // namespace gnomon::config
