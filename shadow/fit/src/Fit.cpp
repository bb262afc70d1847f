#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>

namespace gnomon::shadow_fit {
namespace {

bool contains(std::span<const std::string_view> words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

Result<TechniqueName> parseTechnique(std::string_view text,
                                     std::span<const std::string_view> filters) {
    if (text == "none") return TechniqueName{};
    if (text == "ray") return TechniqueName{.traced = true};
    const auto plus = text.find('+');
    TechniqueName name{
        .fit = std::string{text.substr(0, plus)},
        .filter = plus == std::string_view::npos ? "hard" : std::string{text.substr(plus + 1)}};
    if (plus == std::string_view::npos && contains(filters, name.fit))
        name = {.fit = "std", .filter = std::string{text}};
    std::string known = "none ray";
    bool fitKnown = false;
    for (const FitInfo& info : fits()) {
        fitKnown = fitKnown || info.name == name.fit;
        known += " " + std::string{info.name};
    }
    if (!fitKnown)
        return fail(Errc::config, "technique \"" + std::string{text} + "\": no fit is called \"" +
                                      name.fit + "\", expected one of: " + known);
    if (!contains(filters, name.filter)) {
        std::string all;
        for (const auto filter : filters) all += (all.empty() ? "" : " ") + std::string{filter};
        return fail(Errc::config, "technique \"" + std::string{text} +
                                      "\": no filter is called \"" + name.filter +
                                      "\", expected one of: " + all);
    }
    return name;
}

}  // namespace gnomon::shadow_fit
