#include "Plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "Sweeps.h"

namespace gnomon::client {
namespace {

/// Maps of no size: without maps their size does not matter, so one of them is enough.
bool hasMaps(const std::string& technique, const Registry& registry) {
    return technique != "none" && std::find(registry.others.begin(), registry.others.end(),
                                            technique) == registry.others.end();
}

}  // namespace

Sun sunSeenFrom(const Look& look, const RelativeSun& sun) {
    math::dvec3 ahead = look.center - look.eye;
    ahead.y = 0.0;
    // Straight up or down: north is ahead.
    ahead = glm::length(ahead) > 0.0 ? glm::normalize(ahead) : math::dvec3{0.0, 0.0, -1.0};
    const math::dvec3 right{-ahead.z, 0.0, ahead.x};
    const double flat = std::cos(sun.elevation);
    return {.toward = flat * (std::sin(sun.azimuth) * right - std::cos(sun.azimuth) * ahead) +
                      math::dvec3{0.0, std::sin(sun.elevation), 0.0},
            .angle = sun.angle};
}

bool BenchView::fits(const std::string& sceneFile) const {
    const std::filesystem::path file{sceneFile};
    return scene.empty() || scene == file.filename() || scene == file.stem();
}

Variant variant(const std::string& technique, int mapSize) {
    return {.label = technique, .shadow = {.technique = technique, .mapSize = mapSize}};
}

const char* name(Motion motion) noexcept { return motion == Motion::still ? "static" : "dynamic"; }

std::vector<Variant> variantsOf(const std::vector<std::string>& techniques,
                                const std::vector<int>& mapSizes, const Registry& registry) {
    std::vector<Variant> all;
    for (const int size : mapSizes)
        for (const auto& technique : techniques)
            if (size == mapSizes.front() || hasMaps(technique, registry))
                all.push_back(variant(technique, size));
    return all;
}

Result<std::vector<Chapter>> chaptersOf(const PlanOptions& options, const Registry& registry) {
    std::vector<Chapter> chapters;
    if (options.sweep.empty()) {
        const auto techniques = options.techniques.empty() ? std::vector<std::string>{"none", "std"}
                                                           : options.techniques;
        const auto sizes = options.mapSizes.empty() ? std::vector{1024} : options.mapSizes;
        chapters.push_back({.variants = variantsOf(techniques, sizes, registry),
                            .views = {BenchView{}},
                            .sizes = {{1024, 1024}}});
    } else {
        auto made = sweep(options, registry);
        if (!made) return made;
        chapters = *std::move(made);
    }
    for (Chapter& chapter : chapters) {
        if (!options.sizes.empty()) chapter.sizes = options.sizes;
        if (!options.motions.empty()) chapter.motions = options.motions;
        if (!options.views.empty()) chapter.views = options.views;
        if (options.flickerFrames) chapter.flickerFrames = *options.flickerFrames;
    }
    return chapters;
}

}  // namespace gnomon::client
