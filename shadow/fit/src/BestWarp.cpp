#include "BestWarp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gnomon::shadow_fit {
namespace {

using glm::dmat2;
using math::dmat3;
using math::dvec2;
using math::dvec3;

/// A sample on the light's plane.
struct Point {
    dvec2 at{0.0};
    double weight = 0.0;  ///< times metres to a length of the plane
};

struct Found {
    double error = std::numeric_limits<double>::infinity();
    dmat3 map{1.0};  ///< the outline's parallelogram to [-1, 1]^2
};

class Search {
public:
    Search(const Ground& ground, std::span<const Sample> samples) : hull_{ground.outline.hull} {
        for (const dvec2& p : hull_) size_ = std::max({size_, std::abs(p.x), std::abs(p.y)});
        for (const Sample& sample : samples) {
            const dvec3 h = ground.plane.at(sample.world);
            if (h.z > 0.0) points_.push_back({dvec2{h} / h.z, sample.weight * h.z});
        }
    }

    /// The best map whose perspective is along an angle, of a strength.
    Found at(double angle, double strength) const {
        const dvec2 a{std::cos(angle), std::sin(angle)};
        const dvec2 b{a.y, -a.x};
        const Extent extent = extentAlong(hull_, a);
        if (!(extent.length() > 1e-9 * size_)) return {};
        const double k = strength / extent.length();
        dmat3 warp{1.0};  // without a crop
        warp[0] = {b.x, a.x, k * a.x};
        warp[1] = {b.y, a.y, k * a.y};
        warp[2] = {0.0, -extent.low, 1.0 - k * extent.low};

        std::vector<dvec2> outline;
        for (const dvec2& p : hull_) {
            const dvec3 h = warp * dvec3{p, 1.0};  // h.z >= 1
            outline.push_back(dvec2{h} / h.z);
        }
        const auto steps = stepsAfter(warp);
        const auto whitened = whitenedBy(steps);
        if (!whitened) return {};
        for (dvec2& p : outline) p = *whitened * p;
        const auto sides = leastParallelogram(outline);
        if (!sides) return {};
        // Its corner and sides, back where the outline was: the columns of square-to-outline.
        const dmat2 back = glm::inverse(*whitened);  // its determinant a c is above zero
        const dmat2 half = back * dmat2{sides->first * 0.5, sides->second * 0.5};
        const dvec2 middle = back * sides->middle;
        if (!(std::abs(cross(half[0], half[1])) > 0.0))
            return {};  // flat, in what doubles can hold
        dmat3 outlineFromSquare{1.0};
        outlineFromSquare[0] = {half[0], 0.0};
        outlineFromSquare[1] = {half[1], 0.0};
        outlineFromSquare[2] = {middle, 1.0};
        double error = 0.0;
        for (const Step& step : steps)
            error += step.weight *
                     (glm::length(step.onPlane * half[0]) + glm::length(step.onPlane * half[1]));
        return {.error = error, .map = glm::inverse(outlineFromSquare) * warp};
    }

private:
    /// What a step in the warped plane is on the light's plane, at a sample.
    struct Step {
        dmat2 onPlane{1.0};
        double weight = 0.0;
    };
    std::vector<Step> stepsAfter(const dmat3& warp) const {
        std::vector<Step> steps;
        steps.reserve(points_.size());
        for (const Point& point : points_) {
            const dvec3 q = warp * dvec3{point.at, 1.0};
            if (!(q.z > 0.0)) continue;
            const dvec2 at = dvec2{q} / q.z;
            const dmat2 moved{(dvec2{warp[0]} - at * warp[0].z) / q.z,
                              (dvec2{warp[1]} - at * warp[1].z) / q.z};
            const double area = glm::determinant(moved);
            if (std::abs(area) > 0.0 && std::isfinite(area))
                steps.push_back({glm::inverse(moved), point.weight});
        }
        return steps;
    }

    /// A map of the warped plane after which lengths are about what is looked for: the sum of the
    /// lengths of a step over all samples. (A sum of lengths is no quadratic form; each square is
    /// divided by what the length is like.)
    static std::optional<dmat2> whitenedBy(const std::vector<Step>& steps) {
        double xx = 0.0, xy = 0.0, yy = 0.0;
        for (const Step& step : steps) {
            const dvec2 u{step.onPlane[0][0], step.onPlane[1][0]};  // rows
            const dvec2 v{step.onPlane[0][1], step.onPlane[1][1]};
            const double length = std::sqrt(glm::dot(u, u) + glm::dot(v, v));
            if (!(length > 0.0)) continue;  // underflown
            const double weight = step.weight / length;
            xx += weight * (u.x * u.x + v.x * v.x);
            xy += weight * (u.x * u.y + v.x * v.y);
            yy += weight * (u.y * u.y + v.y * v.y);
        }
        // Cholesky: |L^T p|^2 = p^T (L L^T) p.
        const double a = std::sqrt(xx);
        if (!(a > 0.0)) return {};
        const double b = xy / a;
        const double c = std::sqrt(std::max(yy - b * b, 0.0));
        if (!(a * c > 0.0) || !std::isfinite(a * c)) return {};
        return dmat2{dvec2{a, 0.0}, dvec2{b, c}};
    }

    struct Sides {
        dvec2 first{0.0}, second{0.0}, middle{0.0};
    };
    /// Of the least perimeter, with one side on an edge and the other on an edge or across.
    static std::optional<Sides> leastParallelogram(const std::vector<dvec2>& outline) {
        std::vector<dvec2> directions;
        std::vector<Extent> across;  // of the outline, beside each direction
        const auto add = [&](const dvec2& edge) {
            const double length = glm::length(edge);
            if (!(length > 0.0)) return;
            directions.push_back(edge / length);
            across.push_back(extentAlong(outline, dvec2{-edge.y, edge.x} / length));
        };
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const dvec2 edge = outline[(i + 1) % outline.size()] - outline[i];
            add(edge);
            add({-edge.y, edge.x});
        }
        std::optional<Sides> best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < directions.size(); i += 2) {
            for (std::size_t j = 0; j < directions.size(); ++j) {
                const double sine = std::abs(cross(directions[i], directions[j]));
                if (!(sine > 0.1)) continue;
                const double perimeter = (across[i].length() + across[j].length()) / sine;
                if (!(perimeter < least)) continue;
                least = perimeter;
                // Where the middles of both strips cross.
                const dvec2 ni{-directions[i].y, directions[i].x};
                const dvec2 nj{-directions[j].y, directions[j].x};
                const double ci = 0.5 * (across[i].low + across[i].high);
                const double cj = 0.5 * (across[j].low + across[j].high);
                const double det = cross(ni, nj);  // as the sine, above a tenth in size
                best = Sides{.first = directions[i] * (across[j].length() / sine),
                             .second = directions[j] * (across[i].length() / sine),
                             .middle = dvec2{ci * nj.y - cj * ni.y, cj * ni.x - ci * nj.x} / det};
            }
        }
        return best;
    }

    std::span<const dvec2> hull_;
    std::vector<Point> points_;
    double size_ = narrowestMap;  ///< what the outline's numbers are like
};

}  // namespace

std::optional<dmat3> bestWarp(const Ground& ground, const Warp& guess, int mapSize,
                              std::span<const Sample> samples) {
    const auto fallback = [&] { return warpedMap(ground.outline.hull, guess, mapSize); };
    if (ground.outline.hull.size() < 3 || samples.empty()) return fallback();
    const Search search{ground, samples};
    double angle = std::atan2(guess.along.y, guess.along.x);
    double strength = std::max(guess.strength, 0.1);
    Found best = search.at(angle, strength);
    // Downhill in steps that shrink; the error is smooth and has few valleys.
    double turn = std::numbers::pi / 9.0;
    double factor = 2.0;
    for (int round = 0; round < 6; ++round) {
        for (const auto& [a, s] :
             {std::pair{angle, strength * factor}, std::pair{angle, strength / factor},
              std::pair{angle + turn, strength}, std::pair{angle - turn, strength}}) {
            Found found = search.at(a, s);
            if (!(found.error < best.error)) continue;
            best = found;
            angle = a;
            strength = s;
        }
        turn *= 0.6;
        factor = std::pow(factor, 0.7);
    }
    if (!std::isfinite(best.error)) return fallback();
    const auto cropped = croppedMap(ground.outline.hull, best.map, mapSize);
    return cropped ? cropped : fallback();
}

}  // namespace gnomon::shadow_fit
