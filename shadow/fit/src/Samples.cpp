#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow_fit {
namespace {

using math::dvec3;

/// A part of a ray within a box.
struct Passage {
    double entry = 0.0, exit = 0.0, density = 0.0;
};

/// Where a ray ends that can pass @p depth of triangles, by their mean number on its way.
double endOf(std::vector<Passage>& passages, double length, double depth) {
    std::sort(passages.begin(), passages.end(),
              [](const Passage& a, const Passage& b) { return a.entry < b.entry; });
    for (const Passage& p : passages) {
        if (!std::isfinite(p.density)) return p.entry;
        const double met = (p.exit - p.entry) * length * p.density;
        if (met > depth) return p.entry + depth / (length * p.density);
        depth -= met;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Sample> samplePicture(std::span<const math::View> views, const Boxes& boxes,
                                  int perSide, const std::optional<DepthSpan>& depth) {
    constexpr double opaque = std::numeric_limits<double>::infinity();
    std::vector<Sample> samples;
    std::vector<Passage> passages;
    for (const math::View& view : views) {
        if (!view.usable()) continue;
        const math::dmat4 worldFromClip = math::inverted(view.clipFromWorld());
        const auto unproject = [&](double x, double y, double z) {
            const math::dvec4 p = worldFromClip * math::dvec4{x, y, z, 1.0};
            // Infinitely far away, no place: nothing is sampled there.
            return p.w != 0.0 ? dvec3{p} / p.w : dvec3{std::numeric_limits<double>::quiet_NaN()};
        };
        for (int i = 0; i < perSide * perSide; ++i) {
            const double x = (i % perSide + 0.5) / perSide * 2.0 - 1.0;
            const double y = (i / perSide + 0.5) / perSide * 2.0 - 1.0;
            const dvec3 from = unproject(x, y, 1.0);
            const dvec3 direction = unproject(x, y, 0.0) - from;
            if (!isPlace(from) || !isPlace(direction)) continue;
            passages.clear();
            boxes.tree.along(from, direction, [&](std::uint32_t item, double entry, double exit) {
                // A solid box around the eye shows nothing.
                if (boxes.density.empty() && !(entry > 0.0)) return;
                passages.push_back(
                    {entry, exit, boxes.density.empty() ? opaque : boxes.density[item]});
            });
            // Spread evenly over the rays: the golden ratio's multiples. Their logarithm is how
            // many triangles, in the mean, a ray may meet that gets this far by chance.
            const double chance = std::fmod((i + 0.5) * 0.6180339887498949, 1.0);
            const double t = endOf(passages, glm::length(direction), -std::log(1.0 - chance));
            const dvec3 at = from + direction * t;
            if (!(t <= 1.0) || !math::isFinite(at)) continue;
            const double far = -(view.eyeFromWorld * math::dvec4{at, 1.0}).z;
            if (depth && !(far >= depth->near && far <= depth->far)) continue;
            samples.push_back({.world = at});
        }
    }
    return samples;
}

void weigh(std::span<Sample> samples, const LightShape& light, const Boxes& boxes) {
    const bool parallel = light.kind == LightKind::directional;
    const double reach = boxes.tree.bounds().empty() ? 0.0 : 2.0 * boxes.tree.bounds().radius();
    for (Sample& sample : samples) {
        const dvec3 way = parallel ? -light.direction * reach : light.position - sample.world;
        const double length = glm::length(way);
        double met = 0.0;
        boxes.tree.along(sample.world, way, [&](std::uint32_t item, double entry, double exit) {
            exit = std::min(exit, 1.0);
            // The sample is in or on a box of its own; only what is flat is certainly itself.
            if (!(exit > entry) || !(entry < 1.0)) return;
            const double density = boxes.density.empty() ? 0.0 : boxes.density[item];
            met += std::isfinite(density) ? (exit - entry) * length * density
                   : entry > 0.0          ? 1.0
                                          : 0.0;
        });
        // Lit with probability exp(-met); an edge is near where it could be either way. Never
        // nothing: the boxes are a guess.
        const double lit = std::exp(-met);
        sample.weight = 0.05 + 0.95 * 4.0 * lit * (1.0 - lit);
    }
}

}  // namespace gnomon::shadow_fit
