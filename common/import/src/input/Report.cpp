#include "input/Report.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::importer {

namespace {

/// Bytes of the UTF-8 character that @p text begins with; 0 where it is none.
std::size_t characterBytes(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) return 1;
    std::size_t size = 0;
    if (byte(0) >= 0xc2 && byte(0) <= 0xdf) size = 2;
    if (byte(0) >= 0xe0 && byte(0) <= 0xef) size = 3;
    if (byte(0) >= 0xf0 && byte(0) <= 0xf4) size = 4;
    if (size == 0 || text.size() < size) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0U) != 0x80) return 0;
    // Overlong forms, surrogates, and what lies beyond U+10FFFF.
    if ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
        (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f))
        return 0;
    return size;
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
    std::string out;
    while (!text.empty()) {
        const auto size = characterBytes(text);
        if (out.size() + std::max<std::size_t>(size, 1) > longest) return out + "...";
        const bool control = static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f;
        if (size == 0 || control)
            out.push_back('?');
        else
            out += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return out;
}

void Report::warn(std::string text) {
    if (seen_.contains(text)) return;
    if (warnings_.size() >= maxWarnings) {
        ++left_;
        return;
    }
    seen_.insert(text);
    warnings_.push_back(std::move(text));
}

std::vector<std::string> Report::warnings() const {
    auto all = warnings_;
    if (left_ > 0) all.push_back(fmt::format("and {} more warnings", left_));
    return all;
}

}  // namespace gnomon::importer
