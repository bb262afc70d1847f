#include <fmt/format.h>
#include <gnomon/config/Finding.h>

#include <algorithm>

namespace gnomon::config {

std::string Place::prefix() const {
    if (line == 0) return {};
    return fmt::format("{}:{}:{}: ", file, line, column);
}

const Place& Origin::of(std::string_view key) const {
    const auto it = keys.find(key);
    return it == keys.end() ? table : it->second;
}

std::string Finding::text() const {
    return place.prefix() + (level == Level::warning ? "warning: " : "") + what;
}

bool hasError(const std::vector<Finding>& findings) {
    return std::any_of(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.level == Level::error; });
}

Error toError(const std::vector<Finding>& findings) {
    Error error{.code = Errc::config};
    std::size_t count = 0;
    for (const Finding& finding : findings) {
        if (finding.level != Level::error) continue;
        if (count++ == 0) error.what = finding.text();
    }
    if (count > 1) error.what += fmt::format("; and {} more", count - 1);
    return error;
}

}  // namespace gnomon::config
