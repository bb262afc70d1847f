#include "Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace gnomon::config {
namespace {

std::string folded(std::string_view word) {
    std::string result;
    for (const char c : word) {
        result += c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return result;
}

// Levenshtein distance with neighbours swapped as one edit (optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> previous(b.size() + 1);
    std::vector<std::size_t> current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                current[j] = std::min(current[j], before[j - 2] + 1);
            }
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

}  // namespace

std::string tomlText(bool value) { return value ? "true" : "false"; }

std::string tomlText(int value) { return std::to_string(value); }

std::string tomlText(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";  // n: nan, inf
    return text;
}

std::string tomlText(std::string_view value) {
    std::string text = "\"";
    for (const char c : value) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            text += '\\';
            text += c;
        } else if (code < 0x20 || code == 0x7f) {
            text += fmt::format("\\u{:04x}", code);
        } else {
            text += c;
        }
    }
    return text + "\"";
}

std::string detail::bracketed(const std::vector<std::string>& parts) {
    return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string tomlText(const std::array<Colour, 2>& values) {
    return fmt::format("[{}, {}]", tomlText(values[0]), tomlText(values[1]));
}

std::optional<std::string_view> nearest(std::string_view word,
                                        std::span<const std::string_view> words) {
    if (word.size() > 64) return {};
    const std::string from = folded(word);
    std::optional<std::string_view> best = {};
    std::size_t bestDistance = 0;
    for (const std::string_view candidate : words) {
        const std::size_t edits = distance(from, folded(candidate));
        // A third of a word may be wrong; below that another word is as likely.
        if (edits > std::max<std::size_t>(1, std::min(from.size(), candidate.size()) / 3)) continue;
        if (!best || edits < bestDistance) {
            best = candidate;
            bestDistance = edits;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> words) {
    const auto best = nearest(word, words);
    return best ? fmt::format(", did you mean {}?", tomlText(*best)) : std::string{};
}

std::string oneOf(std::span<const std::string_view> words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += tomlText(words[i]);
    }
    return text;
}

}  // namespace gnomon::config
