#include "Precheck.h"

#include <fmt/format.h>

namespace gnomon::config {
namespace {

constexpr int maxKeyParts = 16;

// The text after the string on one line that starts @p text with its quote.
std::string_view afterString(std::string_view text) {
    const char quote = text.front();
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (quote == '"' && text[i] == '\\') {
            ++i;
        } else if (text[i] == '\n') {
            return text.substr(i);  // not closed: the parser will complain here
        } else if (text[i] == quote) {
            return text.substr(i + 1);
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
        if (text.starts_with("\"\"\"") || text.starts_with("'''")) {
            return finding("a text of several lines, which nothing here can be");
        }
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
