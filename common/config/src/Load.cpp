#include <fmt/format.h>
#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <tuple>

#include "Document.h"
#include "Reader.h"

namespace gnomon::config {
namespace {

// A wall of a thousand servers is a third of this.
constexpr std::size_t maxBytes = std::size_t{1} << 20U;

Result<Config> configOf(Inspection&& inspection) {
    if (inspection.config) return *std::move(inspection.config);
    return tl::unexpected{toError(inspection.findings)};
}

}  // namespace

Inspection inspectConfig(std::string_view text, std::string_view filename) {
    Inspection result;
    if (text.size() > maxBytes) {
        const Place start{.file = std::string{filename}, .line = 1, .column = 1};
        result.findings.push_back(
            {.place = start,
             .what = fmt::format("{} bytes, a wall description has at most {}", text.size(),
                                 maxBytes)});
        return result;
    }
    const auto root = parseToml(text, filename, result.findings);
    if (!root) return result;
    Config config = readConfig(*root, result.findings);
    // What does not even read would only lead to more of the same.
    if (result.findings.empty()) result.findings = findings(config);
    std::stable_sort(
        result.findings.begin(), result.findings.end(), [](const Finding& a, const Finding& b) {
            return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
        });
    if (!hasError(result.findings)) result.config = std::move(config);
    return result;
}

Result<Inspection> inspectFile(const std::filesystem::path& path) {
    const auto unreadable = [&] {
        return fail(Errc::file, fmt::format("cannot read the wall description {}", path.string()),
                    std::error_code{errno, std::generic_category()});
    };
    std::error_code ec;
    if (std::filesystem::is_directory(path, ec)) {
        return fail(Errc::file, fmt::format("cannot read the wall description {}: it is a folder",
                                            path.string()));
    }
    errno = 0;
    std::ifstream file{path, std::ios::binary};
    if (!file) return unreadable();
    // One byte more than allowed is enough to refuse, also from a file without an end.
    std::string text(maxBytes + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) return unreadable();
    text.resize(static_cast<std::size_t>(file.gcount()));
    return inspectConfig(text, path.string());
}

Result<Config> parseConfig(std::string_view text, std::string_view filename) {
    return configOf(inspectConfig(text, filename));
}

Result<Config> loadConfig(const std::filesystem::path& path) {
    auto inspection = inspectFile(path);
    if (!inspection) return tl::unexpected{std::move(inspection).error()};
    return configOf(*std::move(inspection));
}

}  // namespace gnomon::config
