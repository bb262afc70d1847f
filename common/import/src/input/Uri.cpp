#include "input/Uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "input/Report.h"

namespace gnomon::importer {
namespace {

int hexDigit(char c) noexcept {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

constexpr std::array<std::int8_t, 256> base64Values() {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < letters.size(); ++i)
        values[static_cast<unsigned char>(letters[i])] = static_cast<std::int8_t>(i);
    values[static_cast<unsigned char>('-')] = 62;
    values[static_cast<unsigned char>('_')] = 63;
    return values;
}

/// "scheme:" as of RFC 3986: a letter, then letters, digits, + - . up to a colon.
bool hasScheme(std::string_view uri) {
    const auto colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    const auto allowed = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
    };
    return std::isalpha(static_cast<unsigned char>(uri[0])) != 0 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), allowed);
}

}  // namespace

Result<std::string> percentDecoded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            out.push_back(text[i]);
            continue;
        }
        const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
        if (high < 0 || low < 0)
            return fail(Errc::file,
                        fmt::format("\"{}\": % is not followed by two hexadecimal digits",
                                    printable(text)));
        out.push_back(static_cast<char>(high * 16 + low));
        i += 2;
    }
    return out;
}

Result<Bytes> base64Decoded(std::string_view text) {
    static constexpr auto values = base64Values();
    const auto given = text.size();
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    if (text.size() % 4 == 1) return fail(Errc::file, "base64 data are cut short");
    Bytes out;
    out.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int value = values[static_cast<unsigned char>(text[i])];
        if (value < 0)
            return fail(Errc::file, fmt::format("base64 data contain \"{}\" (character {} of {})",
                                                printable(text.substr(i, 1)), i + 1, given));
        bits = bits << 6U | static_cast<std::uint32_t>(value);
        if (i % 4 == 1) out.push_back(static_cast<std::byte>(bits >> 4U));
        if (i % 4 == 2) out.push_back(static_cast<std::byte>(bits >> 2U));
        if (i % 4 == 3) out.push_back(static_cast<std::byte>(bits));
    }
    return out;
}

Result<std::shared_ptr<const Bytes>> readUri(std::string_view uri, Folder& folder) {
    const auto refused = [&](std::string_view why) {
        return fail(Errc::file, fmt::format("\"{}\" is not read: {}", printable(uri), why));
    };
    if (uri.substr(0, 5) == "data:") {
        const auto comma = uri.find(',');
        if (comma == std::string_view::npos) return refused("a data: URI without a comma");
        const auto head = uri.substr(5, comma - 5);
        const auto body = uri.substr(comma + 1);
        constexpr std::string_view base64 = ";base64";
        if (head.size() >= base64.size() && head.substr(head.size() - base64.size()) == base64) {
            auto bytes = base64Decoded(body);
            if (!bytes) return tl::unexpected{std::move(bytes).error()};
            return std::make_shared<const Bytes>(*std::move(bytes));
        }
        auto text = percentDecoded(body);
        if (!text) return tl::unexpected{std::move(text).error()};
        const auto raw = std::as_bytes(std::span{*text});
        return std::make_shared<const Bytes>(raw.begin(), raw.end());
    }
    if (hasScheme(uri)) return refused("only data: URIs and files below the model's folder are");
    if (uri.substr(0, 2) == "//") return refused("it names a host");
    auto name = percentDecoded(uri);
    if (!name) return tl::unexpected{std::move(name).error()};
    // Decoding may have made a scheme or an absolute path; locate() judges what comes out.
    return folder.read(*name);
}

}  // namespace gnomon::importer
