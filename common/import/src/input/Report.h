#pragma once

#include <gnomon/base/Error.h>

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::importer {

/// Ends the import: the file cannot be used. main() prints the sentence behind the file's name.
[[noreturn]] inline void refuse(std::string what) { throw Failure{Errc::file, std::move(what)}; }
[[noreturn]] inline void refuseForSize(std::string what) {
    throw Failure{Errc::limit, std::move(what)};
}

/// Text of a file's own making (names, URIs) in a form fit for one line: control characters and
/// bytes that are no UTF-8 become '?', and what is long is cut.
std::string printable(std::string_view text, std::size_t longest = 120);

/// What an import tells besides its result: warnings, and how far it is.
class Report {
public:
    /// Of a file with a fault in each of a million triangles one wants to read some, not all.
    static constexpr std::size_t maxWarnings = 100;

    using Progress = std::function<void(double share, std::string_view what)>;

    explicit Report(Progress progress = {}) : progress_{std::move(progress)} {}

    /// Equal texts are kept once.
    void warn(std::string text);
    void progress(double share, std::string_view what) const {
        if (progress_) progress_(share, what);
    }
    /// In the order they came; the last one says how many were left out, if any.
    std::vector<std::string> warnings() const;

private:
    Progress progress_;
    std::vector<std::string> warnings_;
    std::set<std::string, std::less<>> seen_;
    std::size_t left_ = 0;
};

}  // namespace gnomon::importer
