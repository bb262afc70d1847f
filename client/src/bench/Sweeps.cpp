// The comparisons of Nico Hempe's diploma thesis, chapter 10, and the curve of error and time over
// map sizes. Nico Hempe. Robuste Echtzeitschatten fuer komplexe, dynamische Szenen. 2005.
#include "Sweeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace gnomon::client {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
using Techniques = std::vector<std::string>;

bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// Those of the wanted techniques that are built in. A filter alone means std+filter.
Techniques present(const Techniques& wanted, const Registry& registry) {
    Techniques found;
    for (const auto& technique : wanted) {
        const auto plus = technique.find('+');
        const auto first = technique.substr(0, plus);
        const bool known =
            plus == std::string::npos
                ? first == "none" || has(registry.fits, first) || has(registry.filters, first) ||
                      has(registry.others, first)
                : has(registry.fits, first) && has(registry.filters, technique.substr(plus + 1));
        if (known) found.push_back(technique);
    }
    return found;
}

/// Every fit with the plain lookup, every other filter on the plain fit, and whatever has no map.
Techniques everything(const Registry& registry) {
    Techniques all{"none"};
    all.insert(all.end(), registry.fits.begin(), registry.fits.end());
    for (const auto& filter : registry.filters)
        if (filter != "hard") all.push_back("std+" + filter);
    all.insert(all.end(), registry.others.begin(), registry.others.end());
    // The plain technique is what the others are compared with.
    const auto standard = std::find(all.begin(), all.end(), "std");
    if (standard != all.end()) std::rotate(all.begin(), standard, standard + 1);
    return all;
}

BenchView lit(const char* name, double azimuth, double elevation, double angle = 0.0) {
    return {
        .name = name,
        .sun = RelativeSun{
            .azimuth = azimuth * degree, .elevation = elevation * degree, .angle = angle * degree}};
}

// From the best case of warped maps, light across the view, to their worst, light along it.
const BenchView across = lit("light across", 90, 40);
const BenchView slanting = lit("light slanting", 140, 30);
const BenchView ahead = lit("light ahead", 178, 14);
const BenchView behind = lit("light behind", 10, 30);

Chapter improvements(const Techniques& warped) {
    Chapter chapter{.name = "depth",
                    .about =
                        "Figures 58 and 59: base and top line, here every fit, from the depth "
                        "range that is really seen",
                    .views = {across, ahead},
                    .motions = {Motion::moving}};
    for (const auto& technique : warped) {
        for (const auto use :
             {config::DepthRange::off, config::DepthRange::previous, config::DepthRange::exact}) {
            Variant made = variant(technique, 512);
            made.shadow.depthRange = use;
            made.label = fmt::format("{} depth {}", technique, config::name(use));
            chapter.variants.push_back(std::move(made));
        }
    }
    return chapter;
}

Chapter focusRegions() {
    Chapter chapter{.name = "focus",
                    .about = "Figure 60: focus regions of trapezoidal maps",
                    .variants = {variant("std", 512)},
                    .views = {across}};
    for (const double range : {0.1, 0.2, 0.3, 0.5, 0.7}) {
        Variant made = variant("trapez", 512);
        made.shadow.range = range;
        made.label = fmt::format("trapez range {}", range);
        chapter.variants.push_back(std::move(made));
    }
    return chapter;
}

/// The thesis' kernel, whole and with fewer samples a row, beside ours, usual and with more
/// samples.
Chapter kernels(const Registry& registry) {
    Chapter chapter{.name = "kernels",
                    .about = "Kernels of percentage-closer filtering: width, and samples a row",
                    .variants = {variant("std", 1024)},
                    .views = {lit("light across", 90, 40, 0.27)}};
    for (const auto& [width, samples] : {std::pair{2, 2}, {4, 4}, {8, 2}, {8, 4}, {8, 8}}) {
        Variant made = variant("std+square", 1024);
        made.shadow.kernelWidth = width;
        made.shadow.kernelSamples = samples;
        made.label = fmt::format("std+square {0}x{0} of {1} a row", width, samples);
        chapter.variants.push_back(std::move(made));
    }
    for (const auto& technique :
         present({"std+pcf", "std+rotated", "std+hardware", "std+gauss", "std+ppcf"}, registry))
        chapter.variants.push_back(variant(technique, 1024));
    for (const auto& technique : present({"std+pcf", "std+ppcf"}, registry)) {
        Variant made = variant(technique, 1024);
        made.shadow.qualityMode = true;
        made.label = technique + " quality";
        chapter.variants.push_back(std::move(made));
    }
    return chapter;
}

std::vector<Chapter> thesis(const Registry& registry) {
    const auto hard = present({"std", "trapez", "lispsm", "psm", "csm"}, registry);
    const auto warped = present({"trapez", "lispsm", "psm"}, registry);
    const auto soft = present({"std", "pcf", "ppcf", "vsm", "evsm"}, registry);
    std::vector<Chapter> chapters;
    chapters.push_back({.name = "resolutions",
                        .about = "Figures 43 to 50: map sizes; near, middle and far are in the "
                                 "table's columns",
                        .variants = variantsOf(hard, {512, 1024, 2048}, registry),
                        .views = {across},
                        .motions = {Motion::still, Motion::moving}});
    chapters.push_back({.name = "angles",
                        .about = "Figures 53 to 57: angles between light and view",
                        .variants = variantsOf(hard, {1024}, registry),
                        .views = {across, slanting, ahead, behind}});
    if (!warped.empty()) chapters.push_back(improvements(warped));
    if (has(warped, "trapez")) chapters.push_back(focusRegions());
    if (soft.size() > 1) {
        chapters.push_back({.name = "soft",
                            .about = "Figures 61, 62 and 68: soft shadows of several map sizes",
                            .variants = variantsOf(soft, {512, 1024, 2048}, registry),
                            .views = {lit("light across", 90, 40, 0.27)},
                            .motions = {Motion::moving}});
        chapters.push_back(
            {.name = "extent",
             .about = "Figures 63 to 67: a small and a large light",
             .variants = variantsOf(soft, {1024}, registry),
             .views = {lit("small light", 90, 40, 0.5), lit("large light", 90, 40, 3.0)},
             .motions = {Motion::moving}});
        if (has(registry.filters, "square")) chapters.push_back(kernels(registry));
    }
    for (Chapter& chapter : chapters) chapter.sizes = {{1024, 1024}};
    return chapters;
}

std::vector<Chapter> gates(const PlanOptions& options, const Registry& registry) {
    const auto techniques = options.techniques.empty() ? everything(registry) : options.techniques;
    const auto sizes =
        options.mapSizes.empty() ? std::vector{512, 1024, 2048, 4096} : options.mapSizes;
    return {{.name = "gates",
             .about = "Every technique over map sizes",
             .variants = variantsOf(techniques, sizes, registry),
             .views = {across, slanting, ahead},
             .sizes = {{1024, 1024}},
             .motions = {Motion::still, Motion::moving},
             .flickerFrames = 8}};
}

}  // namespace

std::vector<std::string> sweepNames() { return {"gates", "thesis"}; }

Result<std::vector<Chapter>> sweep(const PlanOptions& options, const Registry& registry) {
    if (options.sweep == "gates") return gates(options, registry);
    if (options.sweep != "thesis")
        return fail(Errc::config, fmt::format("--sweep: found \"{}\", expected {}", options.sweep,
                                              fmt::join(sweepNames(), " or ")));
    if (!options.techniques.empty())
        return fail(Errc::config, "--technique: the sweep thesis chooses its own");
    if (!options.mapSizes.empty())
        return fail(Errc::config, "--map-size: the sweep thesis chooses its own");
    return thesis(registry);
}

}  // namespace gnomon::client
