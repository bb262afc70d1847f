#include "Rule.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace gnomon::config {
namespace {

bool isAlnum(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// The words of the command line's --technique; which of them a build has is the renderer's to say.
constexpr std::array<std::string_view, 7> alone = {"none", "volume",   "planar", "blob",
                                                   "ray",  "lightmap", "auto"};
constexpr std::array<std::string_view, 8> fits = {"std", "trapez", "psm",        "lispsm",
                                                  "csm", "cube",   "paraboloid", "sparse"};
constexpr std::array<std::string_view, 11> filters = {"hard",     "pcf",    "ppcf", "rotated",
                                                      "hardware", "square", "vsm",  "evsm",
                                                      "vsm16",    "evsm16", "gauss"};
constexpr std::array<std::string_view, 3> filtersAlone = {"pcf", "ppcf", "vsm"};  // mean std+...

template <std::size_t n>
bool has(const std::array<std::string_view, n>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::string Rule::expectation(double value) const {
    const bool low = openMin ? !(value > min) : !(value >= min);
    const bool high = openMax ? !(value < max) : !(value <= max);
    if (low || high || !std::isfinite(value)) {
        if (std::isfinite(min) && std::isfinite(max)) {
            if (!openMin && !openMax) return fmt::format("must be {} to {}", min, max);
            return fmt::format("must be {} {} and {} {}", openMin ? ">" : ">=", min,
                               openMax ? "<" : "<=", max);
        }
        if (std::isfinite(min)) return fmt::format("must be {} {}", openMin ? ">" : ">=", min);
        if (std::isfinite(max)) return fmt::format("must be {} {}", openMax ? "<" : "<=", max);
        return "must be finite";
    }
    return number != nullptr ? number(value) : std::string{};
}

std::string Rule::expectation(std::string_view value) const {
    return text != nullptr ? text(value) : std::string{};
}

std::string brokenText(std::string_view subject, std::string_view key, std::string_view value,
                       std::string_view unit, std::string_view expected) {
    return fmt::format("{}{}{} is {}{}{}, {}", subject, subject.empty() ? "" : ": ", key, value,
                       unit.empty() ? "" : " ", unit, expected);
}

std::string nameExpectation(std::string_view value) {
    // Names become arguments of programs and parts of file names.
    const bool good = !value.empty() && value.size() <= 64 && isAlnum(value.front()) &&
                      std::all_of(value.begin(), value.end(), [](char c) {
                          return isAlnum(c) || c == '.' || c == '_' || c == '-';
                      });
    if (good) return {};
    return "must be 1 to 64 letters, digits, '.', '_' or '-', the first a letter or a digit";
}

std::string titleExpectation(std::string_view value) {
    const bool good = !value.empty() && value.size() <= 256 &&
                      std::none_of(value.begin(), value.end(), [](char c) {
                          return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
                      });
    return good ? std::string{} : "must be 1 to 256 bytes of text on one line";
}

std::string hostExpectation(std::string_view value) {
    // A host goes into the command line of a remote shell: nothing that could be an option.
    const auto allowed = [](char c) {
        return isAlnum(c) || c == '.' || c == '_' || c == '-' || c == ':' || c == '%';
    };
    const bool good = value.empty() || (value.size() <= 253 && value.front() != '-' &&
                                        std::all_of(value.begin(), value.end(), allowed));
    return good ? std::string{} : "must be a host name or an IP address";
}

std::string groupExpectation(std::string_view value) {
    const auto colon = value.rfind(':');
    in_addr address{};
    int port = 0;
    if (colon != std::string_view::npos &&
        ::inet_pton(AF_INET, std::string{value.substr(0, colon)}.c_str(), &address) == 1 &&
        IN_MULTICAST(ntohl(address.s_addr))) {
        const char* end = value.data() + value.size();
        const auto [stop, error] = std::from_chars(value.data() + colon + 1, end, port);
        if (error == std::errc{} && stop == end && port >= 1 && port <= 65535) return {};
    }
    return "must be an IPv4 multicast group and a port, such as 239.255.74.30:7430";
}

std::string programExpectation(std::string_view value) {
    if (value.starts_with('-')) return "must be a program, and not begin with '-'";
    return titleExpectation(value);
}

std::string techniqueExpectation(std::string_view value) {
    if (has(alone, value) || has(fits, value) || has(filtersAlone, value)) return {};
    const std::size_t plus = value.find('+');
    if (plus == std::string_view::npos) {
        std::vector<std::string_view> words{fits.begin(), fits.end()};
        words.insert(words.end(), alone.begin(), alone.end());
        words.insert(words.end(), filtersAlone.begin(), filtersAlone.end());
        return "must be " + oneOf(words) + ", or FIT+FILTER" + suggestion(value, words);
    }
    const std::string_view fit = value.substr(0, plus);
    const std::string_view filter = value.substr(plus + 1);
    if (!has(fits, fit)) {
        return "must have a fit before the '+': " + oneOf(fits) + suggestion(fit, fits);
    }
    if (!has(filters, filter)) {
        return "must have a filter after the '+': " + oneOf(filters) + suggestion(filter, filters);
    }
    return {};
}

std::string samplesExpectation(double value) {
    const bool good = value == 1 || value == 2 || value == 4 || value == 8;
    return good ? std::string{} : "must be 1, 2, 4 or 8";
}

std::string rectExpectation(double value) {
    if (value <= 1 || value == std::floor(value)) return {};
    return "must be shares of the window up to 1 or whole pixels above";
}

}  // namespace gnomon::config
