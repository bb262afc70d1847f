#include "input/Report.h"

#include <fmt/format.h>

namespace gnomon::importer {

std::string printable(std::string_view text, std::size_t longest) {
    std::string out;
    for (const char c : text.substr(0, longest))
        out.push_back(static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c);
    if (text.size() > longest) out += "...";
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
