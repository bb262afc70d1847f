#include "CasterVolume.h"

#include <gnomon/shadow_fit/Fit.h>
#include <gnomon/shadow_fit/Outline.h>

#include <algorithm>

namespace gnomon::shadow {
namespace {

using math::dvec2;
using math::dvec3;
using math::dvec4;

/// How far what is seen may go beyond where it was when the page was drawn, in map units: a
/// fortieth of the map's side.
constexpr double play = 0.05;
constexpr std::size_t mostLines = 24;  // with the page's sides within BoxTree::maxPlanes

}  // namespace

void SeenInMap::project(const math::dmat4& clipFromWorld, std::span<const dvec3> seenWorld,
                        const Around& around) {
    points.clear();
    anywhere = false;
    const auto add = [&](const dvec4& clip) {
        if (!(clip.w > 0.0))
            anywhere = true;
        else
            points.push_back(dvec3{clip} / clip.w);
    };
    if (!(around.reach > 0.0)) {
        for (const dvec3& p : seenWorld) {
            add(clipFromWorld * dvec4{p, 1.0});
            if (anywhere) return;
        }
        return;
    }
    // Across the rays, a square around the disk of what is looked up.
    const math::dmat4 rows = glm::transpose(clipFromWorld);
    const dvec3 depth{rows[2]};
    const double steep = glm::length(depth);
    if (!(steep > 0.0)) {
        anywhere = true;
        return;
    }
    const auto [u, v] = shadow_fit::perpendicular(depth / steep);
    const dvec4 alongU = clipFromWorld * dvec4{u, 0.0};
    const dvec4 alongV = clipFromWorld * dvec4{v, 0.0};
    for (const dvec3& p : seenWorld) {
        const double axial =
            around.source.w == 0.0 ? 1.0 : glm::dot(dvec3{around.source} - p, depth) / steep;
        const dvec4 at = clipFromWorld * dvec4{p, 1.0};
        const double reach = around.reach * axial;
        for (const double x : {-reach, reach})
            for (const double y : {-reach, reach}) add(at + alongU * x + alongV * y);
        if (anywhere) return;
    }
}

void CasterVolume::enclose(const math::dmat4& clipFromWorld, std::span<const math::Plane> sides,
                           const SeenInMap& seen, double reach) {
    planes_.assign(sides.begin(), sides.end());
    lines_.clear();
    leastDepth_ = 0.0;
    open_ = true;
    if (seen.anywhere || seen.points.empty()) return;
    std::vector<dvec2> flat;
    flat.reserve(seen.points.size());
    double least = 1.0;
    for (const dvec3& q : seen.points) {
        flat.emplace_back(q);
        least = std::min(least, q.z);
    }
    const auto hull = shadow_fit::convexHull(std::move(flat));
    if (hull.size() < 3 || hull.size() > mostLines) return;
    open_ = false;
    const math::dmat4 rows = glm::transpose(clipFromWorld);
    const auto add = [&](const dvec4& row) {
        const double length = glm::length(dvec3{row});
        if (length > 0.0) planes_.push_back({dvec3{row} / length, row.w / length});
    };
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double length = glm::length(edge);
        if (!(length > 0.0)) continue;
        const dvec2 normal = dvec2{-edge.y, edge.x} / length;  // counter-clockwise: inward
        const dvec3 line{normal, -glm::dot(normal, hull[i])};
        lines_.push_back(line);
        add(rows[0] * line.x + rows[1] * line.y + rows[3] * (line.z + play + reach));
    }
    // What is farther from the light than all that is seen casts on nothing of it.
    leastDepth_ = least;
    add(rows[2] - rows[3] * (least - play * std::max(least, 1e-3)));
}

bool CasterVolume::serves(const SeenInMap& seen) const noexcept {
    if (open_) return true;
    if (seen.anywhere) return false;
    return std::all_of(seen.points.begin(), seen.points.end(), [&](const dvec3& q) {
        if (q.z < leastDepth_ - 0.5 * play * std::max(leastDepth_, 1e-3)) return false;
        return std::all_of(lines_.begin(), lines_.end(), [&](const dvec3& line) {
            return line.x * q.x + line.y * q.y + line.z >= -play;
        });
    });
}

}  // namespace gnomon::shadow
