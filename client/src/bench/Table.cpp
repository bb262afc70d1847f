#include "Table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gnomon::client {

Interval medianOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    const auto at = [&](double rank) {
        return values[static_cast<std::size_t>(std::clamp(rank, 0.0, n - 1.0))];
    };
    const double half = 0.98 * std::sqrt(n);
    return {.median = at(std::floor(n / 2.0)),
            .low = at(std::floor(n / 2.0 - half)),
            .high = at(std::ceil(n / 2.0 + half))};
}

std::vector<bool> paretoFront(const std::vector<BenchRow>& rows) {
    std::vector<bool> front;
    front.reserve(rows.size());
    for (const BenchRow& row : rows) {
        front.push_back(std::none_of(rows.begin(), rows.end(), [&](const BenchRow& other) {
            const double time = other.ratio.median - row.ratio.median;
            const double wrong = other.wrongPercent() - row.wrongPercent();
            return time <= 0.0 && wrong <= 0.0 && (time < 0.0 || wrong < 0.0);
        }));
    }
    return front;
}

std::string slugOf(const std::string& text) {
    std::string slug;
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            slug += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!slug.empty() && slug.back() != '-')
            slug += '-';
    }
    while (!slug.empty() && slug.back() == '-') slug.pop_back();
    return slug;
}

std::string BenchTable::title() const {
    return fmt::format("{}{}{}, {}, {} x {}, {}", chapter, chapter.empty() ? "" : ": ", scene, view,
                       width, height, dynamic ? "dynamic" : "static");
}

std::string BenchTable::slug() const { return slugOf(title()); }

}  // namespace gnomon::client
