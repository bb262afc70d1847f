#include "AutoTechnique.h"

#include <gnomon/base/Error.h>

#include <algorithm>
#include <array>
#include <cstdio>

namespace gnomon::client {
namespace {

/// Where neither budget is given: thirty frames a second.
constexpr double usualFrameMs = 33.3;

std::string text(const Measured& m) {
    std::array<char, 128> line{};
    std::snprintf(line.data(), line.size(), "%s at %d%s: %.1f ms, %.2f %% error",
                  m.technique.c_str(), m.mapSize, m.quality ? " in quality mode" : "", m.ms,
                  m.error);
    return line.data();
}

std::string limit(double value, const char* unit) {
    std::array<char, 32> line{};
    std::snprintf(line.data(), line.size(), "%g %s", value, unit);
    return line.data();
}

bool faster(const Measured& a, const Measured& b) { return a.ms < b.ms; }
bool closer(const Measured& a, const Measured& b) {
    return a.error < b.error || (a.error == b.error && a.ms < b.ms);
}

}  // namespace

Budget budgetOf(const config::Shadow& shadow) noexcept {
    if (!shadow.frameBudget && !shadow.errorBudget) return {.frameMs = usualFrameMs};
    return {.frameMs = shadow.frameBudget, .error = shadow.errorBudget};
}

Choice choose(const std::vector<Measured>& measured, const Budget& budget) {
    GNOMON_EXPECTS(!measured.empty(), "nothing to choose from");
    const auto within = [&](bool frame, bool error) {
        std::vector<Measured> good;
        for (const Measured& m : measured)
            if ((!frame || m.ms <= *budget.frameMs) && (!error || m.error <= *budget.error))
                good.push_back(m);
        return good;
    };
    const auto best = [](const std::vector<Measured>& from, auto less) {
        return *std::min_element(from.begin(), from.end(), less);
    };
    const auto made = [&](const Measured& m, const std::string& why) {
        return Choice{
            .chosen = m,
            .why = text(m) + "; " + why + ", of " + std::to_string(measured.size()) + " tried"};
    };
    const bool frame = budget.frameMs.has_value();
    const std::string ms = frame ? limit(*budget.frameMs, "ms") : "";
    const std::string percent = budget.error ? limit(*budget.error, "%") : "";
    if (budget.error) {
        const auto good = within(frame, true);
        if (!good.empty() && frame)
            return made(best(good, closer), "the least error within " + ms + " and " + percent);
        if (!good.empty()) return made(best(good, faster), "the fastest within " + percent);
        if (!frame)
            return made(best(measured, closer),
                        "nothing is within " + percent + ": the least error there is");
    }
    const auto good = within(true, false);
    if (good.empty())
        return made(best(measured, faster), "nothing is within " + ms + ": the fastest there is");
    return made(best(good, closer),
                "the least error within " + ms +
                    (budget.error ? ", where nothing is within " + percent : ""));
}

std::vector<Measured> candidates(bool extent, bool quality) {
    std::vector<Measured> all;
    for (const char* fit : {"std", "trapez", "lispsm", "csm"})
        for (const int size : {512, 1024, 2048, 4096})
            all.push_back({.technique = std::string{fit} + (extent ? "+ppcf" : ""),
                           .mapSize = size,
                           .quality = quality});
    // Samples are of use once the map is finer than a penumbra.
    if (extent && !quality)
        for (const char* technique : {"lispsm+ppcf", "csm+ppcf"})
            for (const int size : {2048, 4096})
                all.push_back({.technique = technique, .mapSize = size, .quality = true});
    all.push_back({.technique = "ray", .quality = quality});
    return all;
}

}  // namespace gnomon::client
