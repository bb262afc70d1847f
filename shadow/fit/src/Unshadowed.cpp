#include <gnomon/shadow_fit/Fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "LightPlane.h"

namespace gnomon::shadow_fit {
namespace {

using math::dvec2;
using math::dvec3;
using math::Plane;

constexpr int directions = 48;     ///< that the outline is looked at from
constexpr int mostTests = 400;     ///< then what is left stays
constexpr double smallest = 0.01;  ///< pieces of this share of the outline are not cut

/// Where a light sees a point; not a number at a spot or behind it.
dvec2 placeOf(const LightPlane& plane, const dvec3& p) {
    const dvec3 h = plane.at(p);
    return h.z > 0.0 ? dvec2{h} / h.z : dvec2{std::numeric_limits<double>::quiet_NaN()};
}

/// What lies between a flat piece and the light.
class Above {
public:
    /// @param slack  how far above the piece something must be, metres
    /// @param reach  how near to a ray, in units of the plane
    Above(const LightShape& light, const LightPlane& plane, double slack, double reach)
        : light_{light}, plane_{plane}, slack_{slack}, reach_{reach} {}

    /// False where nothing can shadow the piece.
    bool holds(const math::BoxTree& casters, std::span<const dvec3> piece,
               std::span<const dvec2> onPlane, int flat) {
        const double at = piece.front()[flat];
        const double side = plane_.parallel() ? plane_.toward()[flat] : light_.position[flat] - at;
        if (side == 0.0) return false;  // edge-on: not lit
        const double sign = side > 0.0 ? 1.0 : -1.0;
        dvec3 normal{0.0};
        normal[flat] = sign;
        planes_.clear();
        planes_.push_back({normal, -sign * at - slack_});
        const auto hull = convexHull({onPlane.begin(), onPlane.end()});
        if (hull.size() < 3 || hull.size() + 1 > math::BoxTree::maxPlanes) return true;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
            const dvec2 inward{-edge.y, edge.x};
            planes_.push_back(
                plane_.through({inward, reach_ * glm::length(inward) - glm::dot(inward, hull[i])}));
        }
        return casters.any(planes_);
    }

private:
    const LightShape& light_;
    const LightPlane& plane_;
    double slack_;
    double reach_;
    std::vector<Plane> planes_;
};

/// The part of a flat convex piece on one side of a middle: its corners there, and the cuts of all
/// connections.
std::vector<dvec3> halfOf(std::span<const dvec3> piece, int axis, double middle, double sign) {
    std::vector<dvec3> half;
    for (const dvec3& a : piece) {
        const double da = sign * (a[axis] - middle);
        if (da >= 0.0) half.push_back(a);
        if (!(da < 0.0)) continue;
        for (const dvec3& b : piece) {
            const double db = sign * (b[axis] - middle);
            if (db > 0.0) half.push_back(a + (b - a) * (da / (da - db)));
        }
    }
    return half;
}

/// Only the corners of the outline, as the light sees it: cuts leave points within.
std::vector<dvec3> cornersOf(const std::vector<dvec3>& points, const LightPlane& plane) {
    std::vector<dvec2> flat;
    for (const dvec3& p : points) flat.push_back(placeOf(plane, p));
    const auto hull = convexHull(flat);
    std::vector<dvec3> corners;
    for (const dvec2& corner : hull)
        for (std::size_t i = 0; i < points.size(); ++i)
            if (flat[i] == corner) {
                corners.push_back(points[i]);
                break;
            }
    return corners;
}

}  // namespace

bool Receivers::mayBeShadowed(const LightShape& light, const math::BoxTree& casters,
                              double reach) const {
    if (casters.bounds().empty()) return false;
    const auto isFlat = [](const Piece& piece) { return piece.flat >= 0; };
    // What has a volume may shadow itself.
    if (!std::all_of(pieces_.begin(), pieces_.end(), isFlat)) return true;
    const LightPlane plane{light};
    Above above{light, plane, 1e-6 * casters.bounds().radius(), reach};
    std::vector<dvec2> onPlane;
    int tests = 0;
    for (const Piece& piece : pieces_) {
        const auto corners = std::span{points_}.subspan(piece.first, piece.count);
        onPlane.clear();
        for (const dvec3& p : corners) {
            onPlane.push_back(placeOf(plane, p));
            if (std::isnan(onPlane.back().x)) return true;  // at or behind a spot: anywhere
        }
        if (++tests > mostTests || above.holds(casters, corners, onPlane, piece.flat)) return true;
    }
    return false;
}

void Receivers::dropUnshadowed(const LightShape& light, const math::BoxTree& casters,
                               double reach) {
    if (points_.empty() || casters.bounds().empty()) return;
    const LightPlane plane{light};
    std::vector<dvec2> onPlane;
    for (const dvec3& p : points_) {
        onPlane.push_back(placeOf(plane, p));
        if (std::isnan(onPlane.back().x)) return;  // at or behind a spot: anywhere
    }
    Above above{light, plane, 1e-6 * casters.bounds().radius(), reach};

    enum class State : std::uint8_t { open, kept, dropped };
    std::vector<State> states(pieces_.size(), State::open);
    const auto extentOf = [&](std::size_t piece, const dvec2& direction) {
        double furthest = -std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < pieces_[piece].count; ++i)
            furthest = std::max(furthest, glm::dot(onPlane[pieces_[piece].first + i], direction));
        return furthest;
    };
    math::Box whole;
    for (const dvec2& p : onPlane) whole.add(dvec3{p, 0.0});
    const double least = smallest * std::max(whole.size().x, whole.size().y);

    // Splits a piece that is large for what is found out; false where it is small.
    const auto split = [&](std::size_t piece) {
        const std::vector<dvec3> points{this->piece(piece).begin(), this->piece(piece).end()};
        math::Box seen;
        math::Box box;
        for (std::uint32_t i = 0; i < pieces_[piece].count; ++i) {
            seen.add(dvec3{onPlane[pieces_[piece].first + i], 0.0});
            box.add(points[i]);
        }
        if (std::max(seen.size().x, seen.size().y) < least) return false;
        const dvec3 size = box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const int flat = pieces_[piece].flat;
        for (const double sign : {-1.0, 1.0}) {
            const auto half = cornersOf(halfOf(points, axis, box.centre()[axis], sign), plane);
            if (half.size() < 3) continue;
            const std::size_t before = pieces_.size();
            addPiece(half, flat);
            if (pieces_.size() == before) continue;
            states.push_back(State::open);
            while (onPlane.size() < points_.size())
                onPlane.push_back(placeOf(plane, points_[onPlane.size()]));
        }
        return true;
    };

    // Of each direction the pieces by how far they reach, the furthest on top: first by a disk
    // around each, by their points when they come up.
    struct Disk {
        dvec2 middle{0.0};
        double radius = 0.0;
    };
    std::vector<Disk> disks;
    const auto addDisks = [&] {
        while (disks.size() < pieces_.size()) {
            const Piece& piece = pieces_[disks.size()];
            dvec2 low{std::numeric_limits<double>::infinity()};
            dvec2 high{-std::numeric_limits<double>::infinity()};
            for (std::uint32_t i = piece.first; i < piece.first + piece.count; ++i) {
                low = glm::min(low, onPlane[i]);
                high = glm::max(high, onPlane[i]);
            }
            disks.push_back(
                {.middle = (low + high) * 0.5, .radius = glm::length(high - low) * 0.5});
        }
    };
    addDisks();
    struct Reach {
        double extent = 0.0;
        std::size_t piece = 0;
        bool exact = false;
        bool operator<(const Reach& other) const { return extent < other.extent; }
    };
    std::vector<Reach> heap;
    std::vector<double> along;
    int tests = 0;
    for (int i = 0; i < directions && tests < mostTests; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / directions;
        const dvec2 direction{std::cos(angle), std::sin(angle)};
        // What stays for certain ends the search: nothing that reaches less far comes up.
        double kept = -std::numeric_limits<double>::infinity();
        along.clear();
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            along.push_back(glm::dot(disks[p].middle, direction));
            if (pieces_[p].flat < 0 || states[p] == State::kept)
                kept = std::max(kept, along[p] - disks[p].radius);
        }
        heap.clear();
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            if (states[p] != State::dropped && along[p] + disks[p].radius >= kept)
                heap.push_back({along[p] + disks[p].radius, p});
        std::make_heap(heap.begin(), heap.end());
        while (tests < mostTests && !heap.empty()) {
            const std::size_t furthest = heap.front().piece;
            if (!heap.front().exact) {
                std::pop_heap(heap.begin(), heap.end());
                heap.back() = {extentOf(furthest, direction), furthest, true};
                std::push_heap(heap.begin(), heap.end());
                continue;
            }
            if (states[furthest] == State::kept) break;
            const Piece piece = pieces_[furthest];
            if (piece.flat < 0) {
                states[furthest] = State::kept;  // it may shadow itself
                break;
            }
            std::pop_heap(heap.begin(), heap.end());
            heap.pop_back();
            ++tests;
            const std::size_t before = pieces_.size();
            if (!above.holds(casters, this->piece(furthest),
                             std::span{onPlane}.subspan(piece.first, piece.count), piece.flat)) {
                states[furthest] = State::dropped;
            } else if (split(furthest)) {
                states[furthest] = State::dropped;  // its halves are in its place
                addDisks();
                for (std::size_t p = before; p < pieces_.size(); ++p) {
                    heap.push_back({extentOf(p, direction), p, true});
                    std::push_heap(heap.begin(), heap.end());
                }
            } else {
                states[furthest] = State::kept;
                break;
            }
        }
    }
    std::vector<dvec3> points = std::move(points_);
    const std::vector<Piece> pieces = std::move(pieces_);
    clear();
    for (std::size_t p = 0; p < pieces.size(); ++p)
        if (states[p] != State::dropped)
            addWhole(std::span{points}.subspan(pieces[p].first, pieces[p].count), pieces[p].flat);
}

}  // namespace gnomon::shadow_fit
