#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>
#include <cmath>

#include "LightCamera.h"

namespace gnomon::shadow_fit {
namespace {

bool contains(std::span<const std::string_view> words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

Result<TechniqueName> parseTechnique(std::string_view text,
                                     std::span<const std::string_view> filters) {
    if (text == "none") return TechniqueName{};
    const auto plus = text.find('+');
    TechniqueName name{
        .fit = std::string{text.substr(0, plus)},
        .filter = plus == std::string_view::npos ? "hard" : std::string{text.substr(plus + 1)}};
    if (plus == std::string_view::npos && contains(filters, name.fit))
        name = {.fit = "std", .filter = std::string{text}};
    std::string known = "none";
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

std::vector<math::dvec3> receiverPoints(const FitInput& input) {
    std::vector<math::dvec3> points;
    for (const math::View& view : input.views) {
        const math::dmat4 clip = view.clipFromWorld();
        if (!math::isFinite(clip)) continue;
        math::ConvexBody body{math::frustumCorners(clip)};
        body.clip(input.scene);
        if (input.light.kind != LightKind::directional && input.light.range > 0.0) {
            const math::dvec3 reach{input.light.range};
            body.clip(math::Box{.min = input.light.position - reach,
                                .max = input.light.position + reach});
        }
        if (input.light.kind == LightKind::spot) {
            const auto planes = math::frustumPlanes(coneCamera(input.light, 1e-4, 1.0));
            for (int i = 0; i < 4; ++i) body.clip(planes[static_cast<std::size_t>(i)]);
        }
        for (const math::dvec3& p : body.points())
            if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) points.push_back(p);
    }
    return points;
}

}  // namespace gnomon::shadow_fit
