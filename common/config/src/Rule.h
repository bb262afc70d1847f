#pragma once

#include <gnomon/config/Finding.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Text.h"

namespace gnomon::config {

/// What one key's value must be. A list must keep it in each element.
struct Rule {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool openMin = false;  ///< above min, not min itself
    bool openMax = false;
    std::string_view unit = {};
    bool required = false;  ///< the key must be written
    bool always = false;    ///< toToml() writes it even if it is the default
    /// What else a number or a text must be ("must be 1, 2, 4 or 8"), empty if it is.
    std::string (*number)(double) = nullptr;
    std::string (*text)(std::string_view) = nullptr;

    /// "must be >= 0", or empty if @p value is all right. Never right: not a number.
    std::string expectation(double value) const;
    std::string expectation(std::string_view value) const;
};

/// `user: eye_separation is -0.06 m, must be >= 0`; @p subject and @p unit may be empty.
std::string brokenText(std::string_view subject, std::string_view key, std::string_view value,
                       std::string_view unit, std::string_view expected);

std::string nameExpectation(std::string_view value);       ///< of servers and screens
std::string titleExpectation(std::string_view value);      ///< any text on one line, not empty
std::string hostExpectation(std::string_view value);       ///< host name, address, or nothing
std::string groupExpectation(std::string_view value);      ///< IPv4 multicast group and port
std::string programExpectation(std::string_view value);    ///< a path or a name, no option
std::string techniqueExpectation(std::string_view value);  ///< FIT[+FILTER] or a word
std::string samplesExpectation(double value);
std::string rectExpectation(double value);  ///< a share up to 1, or whole pixels

inline std::string expectation(const Rule&, bool) { return {}; }
inline std::string expectation(const Rule&, Eye) { return {}; }
inline std::string expectation(const Rule&, OnTimeout) { return {}; }
inline std::string expectation(const Rule&, DepthRange) { return {}; }
inline std::string expectation(const Rule&, Launch) { return {}; }
inline std::string expectation(const Rule&, Compress) { return {}; }
inline std::string expectation(const Rule& rule, int v) { return rule.expectation(double(v)); }
inline std::string expectation(const Rule& rule, double v) { return rule.expectation(v); }
inline std::string expectation(const Rule& rule, const std::string& v) {
    return rule.expectation(std::string_view{v});
}

namespace detail {
template <class Range>
std::string anyExpectation(const Rule& rule, const Range& values);
}

template <class T, std::size_t n>
std::string expectation(const Rule& rule, const std::array<T, n>& values) {
    return detail::anyExpectation(rule, values);
}
template <class T>
std::string expectation(const Rule& rule, const std::vector<T>& values) {
    return detail::anyExpectation(rule, values);
}
template <class T>
std::string expectation(const Rule& rule, const std::optional<T>& value) {
    return value ? expectation(rule, *value) : std::string{};
}

template <class Range>
std::string detail::anyExpectation(const Rule& rule, const Range& values) {
    for (const auto& value : values) {
        if (std::string wrong = expectation(rule, value); !wrong.empty()) return wrong;
    }
    return {};
}

}  // namespace gnomon::config
