#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "Plain.h"

namespace gnomon::shadow_fit {
namespace {

bool contains(std::span<const std::string_view> words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool fitsFloats(const Fitted& fitted) {
    constexpr double most = std::numeric_limits<float>::max();
    for (const FittedMap& map : fitted.maps)
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                if (!(std::abs(map.clipFromWorld[column][row]) <= most)) return false;
    return true;
}

bool isUsable(const Sample& sample) {
    return isPlace(sample.world) && sample.weight >= 0.0 && sample.weight <= 1.0;
}

}  // namespace

std::optional<LightShape> usableLight(const LightShape& light) noexcept {
    LightShape usable = light;
    const bool parallel = light.kind == LightKind::directional;
    // Scaled first: the square of what is small is zero.
    const math::dvec3 d = light.direction;
    const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const bool directed = math::isFinite(d) && largest > 0.0;
    if (directed && !(std::abs(glm::dot(d, d) - 1.0) < 1e-12))
        usable.direction = glm::normalize(d / largest);
    if (!directed && light.kind != LightKind::point) return {};
    if (!directed) usable.direction = math::dvec3{0.0, -1.0, 0.0};
    if (parallel) usable.position = math::dvec3{0.0};
    if (!isPlace(usable.position)) return {};
    if (!(usable.halfAngle > 0.0) && light.kind == LightKind::spot) usable.halfAngle = 0.0;
    // As far as anything is, which is without a limit.
    if (!(usable.range > 0.0) || usable.range > farthestPlace) usable.range = 0.0;
    if (!(usable.extent > 0.0) || !std::isfinite(usable.extent)) usable.extent = 0.0;
    return usable;
}

Fitted fitted(const FitInfo& info, const FitInput& input) {
    if (input.receivers.empty()) return {};
    const auto light = usableLight(input.light);
    if (!light) return {.degenerate = true};
    FitInput usable = input;
    usable.light = *light;
    usable.mapSize = std::clamp(input.mapSize, 8, 65536);
    if (!(input.reach > 0.0) || input.reach > farthestPlace) usable.reach = 0.0;
    if (!std::isfinite(usable.settings.range)) usable.settings.range = FitSettings{}.range;
    // Casters beyond any place are clamped to the map's near side, as all are that are nearer.
    if (!isPlace(input.scene.min) || !isPlace(input.scene.max)) usable.scene = {};
    std::vector<math::View> views;
    if (!std::all_of(input.views.begin(), input.views.end(),
                     [](const math::View& view) { return view.usable(); })) {
        std::copy_if(input.views.begin(), input.views.end(), std::back_inserter(views),
                     [](const math::View& view) { return view.usable(); });
        usable.views = views;
    }
    std::vector<Sample> samples;
    if (!std::all_of(input.samples.begin(), input.samples.end(), isUsable)) {
        std::copy_if(input.samples.begin(), input.samples.end(), std::back_inserter(samples),
                     isUsable);
        usable.samples = samples;
    }
    Fitted made = info.fit(usable);
    if (fitsFloats(made)) return made;
    if (made.mapSize > 0) usable.mapSize = made.mapSize;
    Fitted plain = plainFit(usable);
    plain.mapSize = made.mapSize;
    plain.degenerate = true;
    if (!fitsFloats(plain)) plain.maps.clear();
    return plain;
}

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
