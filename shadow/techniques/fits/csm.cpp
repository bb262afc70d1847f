// Cascaded shadow maps: slices of the view's depth, each with a map of its own.
// Wolfgang Engel. Cascaded Shadow Maps. ShaderX5, 2006. Fan Zhang, Hanqiu Sun, Leilei Xu, Lee Kit
// Lun. Parallel-Split Shadow Maps for Large-scale Virtual Environments. 2006.
// Splits by what is seen: Andrew Lauritzen, Marco Salvi, Aaron Lefohn. Sample Distribution Shadow
// Maps. 2011. Snapping to texels: Michal Valient. Stable Rendering of Cascaded Shadow Maps.
// ShaderX6, 2008.
//
// Where we depart from them: a slice is fitted to the receivers in it, not to its frustum; and the
// splits are those with the least expected error, found exactly by dynamic programming over a
// number of thin slices. Sizes and angles go in steps and corners on whole texels, so that a map
// stays as it is, bit for bit, until a step is taken.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../fit/src/Plain.h"

namespace gnomon::shadow_fit {
namespace {

using math::dmat3;
using math::dvec2;
using math::dvec3;

constexpr int slices = 32;
constexpr int angles = 12;           ///< steps of a quarter turn
constexpr double sizesAnOctave = 8;  ///< steps of a map's sides
constexpr double depthSteps = 16;    ///< of the depths' range, at the least half as many

/// A thin slice of the view's depth.
struct Slice {
    std::vector<dvec2> hull = {};  ///< of the receivers in it, on the light's plane
    double samples = 0.0;          ///< their weight
};

/// Depths where slices end: evenly in the logarithm, where pixels grow with depth.
std::array<double, slices + 1> boundsOf(const Viewer& viewer) {
    std::array<double, slices + 1> bounds;
    const double ratio = viewer.farthest / viewer.nearest;
    for (int i = 0; i <= slices; ++i)
        bounds[static_cast<std::size_t>(i)] =
            viewer.nearest * std::pow(ratio, static_cast<double>(i) / slices);
    bounds.front() = 0.0;
    bounds.back() = std::numeric_limits<double>::infinity();
    return bounds;
}

std::size_t sliceOf(const std::array<double, slices + 1>& bounds, double depth) {
    const auto at = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, depth);
    return static_cast<std::size_t>(at - bounds.begin()) - 1;
}

/// Every piece of the receivers, cut at the bounds. What a plane cuts of the hull of some points is
/// the hull of the cuts of all their connections.
std::vector<Slice> slicesOf(const FitInput& input, const LightPlane& plane, const Viewer& viewer) {
    const auto bounds = boundsOf(viewer);
    std::vector<Slice> made(slices);
    const auto put = [&](std::size_t slice, const dvec3& p) {
        const dvec3 h = plane.at(p);
        made[slice].hull.push_back(dvec2{h} / h.z);
    };
    for (std::size_t piece = 0; piece < input.receivers.pieces(); ++piece) {
        const auto points = input.receivers.piece(piece);
        std::size_t first = slices - 1;
        std::size_t last = 0;
        for (const dvec3& p : points) {
            const std::size_t slice = sliceOf(bounds, viewer.depthOf(p));
            first = std::min(first, slice);
            last = std::max(last, slice);
            put(slice, p);
        }
        for (std::size_t k = first; k < last; ++k) {
            const double bound = bounds[k + 1];
            for (const dvec3& a : points) {
                const double da = viewer.depthOf(a);
                if (!(da < bound)) continue;
                for (const dvec3& b : points) {
                    const double db = viewer.depthOf(b);
                    if (!(db > bound)) continue;  // so db - da is above zero
                    const dvec3 cut = a + (b - a) * ((bound - da) / (db - da));
                    put(k, cut);
                    put(k + 1, cut);
                }
            }
        }
    }
    for (Slice& slice : made) slice.hull = dilated(convexHull(std::move(slice.hull)), input.reach);
    for (const Sample& sample : input.samples) {
        const double depth = viewer.depthOf(sample.world);
        if (depth > 0.0) made[sliceOf(bounds, depth)].samples += sample.weight;
    }
    return made;
}

struct Rectangle {
    dvec2 low{std::numeric_limits<double>::infinity()};
    dvec2 high{-std::numeric_limits<double>::infinity()};
    bool empty() const { return !(low.x <= high.x); }
    void add(const dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Rectangle& r) {
        low = glm::min(low, r.low);
        high = glm::max(high, r.high);
    }
};

/// A side of a map that holds @p length: the next of the steps, with room for a texel of snapping
/// and two of what a lookup reaches beyond the receivers at each end.
double steppedSide(double length, double least, int mapSize) {
    const double needed = std::max(length, least) * mapSize / std::max(mapSize - 6, 1);  // > 0
    return std::exp2(std::ceil(std::log2(needed) * sizesAnOctave - 1e-9) / sizesAnOctave);
}

/// Depths in steps, outward: they would else move with whatever is cut by the view's sides, and
/// every texel's depth with them.
LightPlane::Depth stepped(const LightPlane::Depth& depth, bool parallel) {
    if (!parallel) {
        // A spot's begin at a share of where they end.
        const double step =
            std::exp2(std::ceil(std::log2(depth.farthest) * sizesAnOctave - 1e-9) / sizesAnOctave);
        return {.nearest = step * (depth.nearest / depth.farthest), .farthest = step};
    }
    const double range = depth.farthest - depth.nearest;  // above zero, as depthOf() leaves it
    const double step = std::exp2(std::ceil(std::log2(range))) / depthSteps;
    return {.nearest = std::floor(depth.nearest / step) * step,
            .farthest = std::ceil(depth.farthest / step) * step};
}

/// Splits of the slices into maps: which slice each map begins with.
struct Plan {
    double error = std::numeric_limits<double>::infinity();
    double angle = 0.0;
    std::vector<Rectangle> maps = {};  ///< in the turned plane
};

class Planner {
public:
    Planner(const std::vector<Slice>& all, int maps, int mapSize, double least)
        : all_{all}, maps_{maps}, mapSize_{mapSize}, least_{least} {}

    /// The best splits for a map that is turned by an angle.
    Plan plan(double angle) const {
        const dvec2 x{std::cos(angle), std::sin(angle)};
        const dvec2 y{-x.y, x.x};
        std::array<Rectangle, slices> turned;
        for (std::size_t i = 0; i < slices; ++i)
            for (const dvec2& p : all_[i].hull) turned[i].add({glm::dot(p, x), glm::dot(p, y)});

        // error[k][i]: of the slices from i on in at most k + 1 maps.
        constexpr double none = std::numeric_limits<double>::infinity();
        std::vector<std::array<double, slices + 1>> error(static_cast<std::size_t>(maps_));
        std::vector<std::array<std::size_t, slices + 1>> next(static_cast<std::size_t>(maps_));
        for (std::size_t k = 0; k < error.size(); ++k) {
            error[k].fill(none);
            error[k][slices] = 0.0;
            for (std::size_t i = slices; i-- > 0;) {
                Rectangle box;
                double samples = 0.0;
                for (std::size_t end = i + 1; end <= slices; ++end) {
                    box.add(turned[end - 1]);
                    samples += all_[end - 1].samples;
                    const double rest = k > 0 ? error[k - 1][end] : end == slices ? 0.0 : none;
                    const double here = rest + samples * sideOf(box);
                    if (here < error[k][i]) {
                        error[k][i] = here;
                        next[k][i] = end;
                    }
                }
            }
        }
        Plan plan{.error = error.back()[0], .angle = angle};
        std::size_t at = 0;
        for (std::size_t k = error.size(); k-- > 0 && at < slices;) {
            Rectangle box;
            for (std::size_t i = at; i < next[k][at]; ++i) box.add(turned[i]);
            if (!box.empty()) plan.maps.push_back(box);
            at = next[k][at];
        }
        return plan;
    }

private:
    double sideOf(const Rectangle& box) const {
        if (box.empty()) return 0.0;
        const dvec2 size = box.high - box.low;
        return 0.5 *
               (steppedSide(size.x, least_, mapSize_) + steppedSide(size.y, least_, mapSize_));
    }
    const std::vector<Slice>& all_;
    int maps_;
    int mapSize_;
    double least_;
};

/// As many texels in all as one map of the size that was asked for; whole pages, or of a smaller
/// map whole multiples of eight.
int sizeOf(const FitInput& input) {
    const int maps = std::clamp(input.settings.cascades, 2, 8);
    const auto share = static_cast<int>(input.mapSize / std::sqrt(static_cast<double>(maps)));
    const int unit = share > pageTexels ? pageTexels : 8;
    return std::max(16, share / unit * unit);
}

Fitted fit(const FitInput& input) {
    if (input.receivers.empty()) return {};
    const int mapSize = sizeOf(input);
    Ground ground{input};
    ground.depth = stepped(ground.depth, ground.plane.parallel());
    // All lights' maps of a view must be of one size, the plain one too.
    const auto plain = [&] {
        return Fitted{.maps = {{.clipFromWorld = ground.clipFromWorld(
                                    uniformMap(ground.outline.hull, mapSize))}},
                      .mapSize = mapSize,
                      .degenerate = true};
    };
    const auto viewer = viewerOf(input);
    if (!viewer || ground.outline.atLight || input.samples.empty()) return plain();
    const int maps = std::clamp(input.settings.cascades, 2, 8);
    double size = 0.0;
    for (const dvec2& p : ground.outline.hull)
        size = std::max({size, std::abs(p.x), std::abs(p.y)});
    const double least = 1e-6 * size + narrowestMap;
    const auto all = slicesOf(input, ground.plane, *viewer);
    const Planner planner{all, maps, mapSize, least};
    Plan best;
    for (int i = 0; i < angles; ++i) {
        Plan plan = planner.plan(i * std::numbers::pi / 2.0 / angles);
        // A step must be worth it, or rounding would turn the maps to and fro.
        if (plan.error < best.error * (1.0 - 1e-9)) best = std::move(plan);
    }
    if (best.maps.empty()) return plain();

    Fitted fitted{.mapSize = mapSize};
    const dvec2 x{std::cos(best.angle), std::sin(best.angle)};
    const dvec2 y{-x.y, x.x};
    for (const Rectangle& box : best.maps) {
        const dvec2 extent = box.high - box.low;
        const dvec2 side{steppedSide(extent.x, least, mapSize),
                         steppedSide(extent.y, least, mapSize)};
        // The corner is on a whole texel: what is drawn moves with the world.
        const dvec2 texel = side / static_cast<double>(mapSize);
        const dvec2 low = glm::floor(((box.low + box.high - side) * 0.5) / texel) * texel;
        const dvec2 scale = 2.0 / side;
        dmat3 map{1.0};
        map[0] = {x.x * scale.x, y.x * scale.y, 0.0};
        map[1] = {x.y * scale.x, y.y * scale.y, 0.0};
        map[2] = {-low.x * scale.x - 1.0, -low.y * scale.y - 1.0, 1.0};
        fitted.maps.push_back({.clipFromWorld = ground.clipFromWorld(map)});
    }
    return fitted;
}

}  // namespace

FitInfo describe_csm() {
    return {.name = "csm",
            .source = "Engel 2006; Lauritzen et al. 2011",
            .fit = fit,
            .sampled = true,
            .stable = true};
}

}  // namespace gnomon::shadow_fit
