#pragma once

#include <gnomon/math/Types.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::math {

/// A bounding-volume hierarchy over boxes that move: what is outside some planes is skipped by the
/// branch. Moved boxes refit their branches; when that has made the tree loose, it is built anew.
class BoxTree {
public:
    static constexpr std::size_t maxPlanes = 32;

    /// Takes the boxes; numbers are their places here. Empty ones are never found.
    void build(std::vector<Box> boxes);
    /// From the next refit() on.
    void move(std::uint32_t item, const Box& box);
    void refit();

    std::span<const Box> boxes() const noexcept { return boxes_; }
    /// Around all of them.
    Box bounds() const noexcept { return nodes_.empty() ? Box{} : nodes_.front().box; }

    /// Calls found(item, inside) for every box that is not certainly outside one of the planes
    /// (at most maxPlanes, points with a distance >= 0 are inside); `inside` where it is certainly
    /// inside all of them. In no particular order, the same for the same history.
    template <class Found>
    void visit(std::span<const Plane> planes, Found&& found) const {
        look(
            planes, [](const Box&) { return false; },
            [&](const Box&, std::uint32_t item, bool inside) { found(item, inside); });
    }
    /// Calls found(box, inside) for boxes that together hold all those that visit() finds: whole
    /// branches where enough(box) says that their box will do.
    template <class Enough, class Found>
    void cover(std::span<const Plane> planes, Enough&& enough, Found&& found) const {
        look(planes, enough,
             [&](const Box& box, std::uint32_t, bool inside) { found(box, inside); });
    }

    /// Whether any box is not certainly outside one of the planes.
    bool any(std::span<const Plane> planes) const noexcept;

    /// Calls found(item, entry, exit) for every box that a ray passes, in no particular order: from
    /// where to where, in lengths of its direction, 0 <= entry <= exit.
    template <class Found>
    void along(const dvec3& from, const dvec3& direction, Found&& found) const {
        if (nodes_.empty()) return;
        const Ray ray{from, direction};
        std::uint32_t open[64];
        std::size_t count = 0;
        open[count++] = 0;
        while (count > 0) {
            const std::uint32_t index = open[--count];
            const Node& node = nodes_[index];
            double entry = 0.0;
            double exit = 0.0;
            if (!passes(node.box, ray, entry, exit)) continue;
            if (node.count == 0) {
                open[count++] = node.second;
                open[count++] = index + 1;
                continue;
            }
            for (std::uint32_t i = 0; i < node.count; ++i) {
                const std::uint32_t item = order_[node.first + i];
                if (passes(boxes_[item], ray, entry, exit)) found(item, entry, exit);
            }
        }
    }

private:
    struct Node {
        Box box = {};
        std::uint32_t first = 0;   ///< leaf: in order_
        std::uint32_t count = 0;   ///< leaf: items; 0: an inner node, its first child follows it
        std::uint32_t second = 0;  ///< inner node: its other child
        std::uint32_t parent = 0;
    };

    template <class Enough, class Found>
    void look(std::span<const Plane> planes, Enough&& enough, Found&& found) const {
        if (nodes_.empty()) return;
        struct Open {
            std::uint32_t node = 0;
            std::uint32_t planes = 0;  ///< those that cut it
        };
        Open open[64];  // the tree is balanced: never deeper
        std::size_t count = 0;
        open[count++] = {0U, allOf(planes)};
        while (count > 0) {
            Open at = open[--count];
            const Node& node = nodes_[at.node];
            if (!cut(node.box, planes, at.planes)) continue;
            if (node.count == 0 && enough(node.box)) {
                found(node.box, node.first, at.planes == 0);
                continue;
            }
            if (node.count == 0) {
                open[count++] = {node.second, at.planes};
                open[count++] = {at.node + 1, at.planes};
                continue;
            }
            for (std::uint32_t i = 0; i < node.count; ++i) {
                const std::uint32_t item = order_[node.first + i];
                std::uint32_t left = at.planes;
                if (cut(boxes_[item], planes, left)) found(boxes_[item], item, left == 0);
            }
        }
    }

    /// A bit for each.
    static std::uint32_t allOf(std::span<const Plane> planes) noexcept {
        return planes.size() >= 32 ? ~0U : (1U << planes.size()) - 1U;
    }
    /// False where the box is outside; else the planes that cut it are left in @p which.
    static bool cut(const Box& box, std::span<const Plane> planes, std::uint32_t& which) noexcept {
        if (box.empty()) return false;
        for (std::uint32_t left = which; left != 0; left &= left - 1U) {
            const auto i = static_cast<unsigned>(__builtin_ctz(left));
            const Plane& plane = planes[i];
            const dvec3 centre = box.min + box.max;
            const dvec3 extent = box.max - box.min;
            const double middle = glm::dot(plane.normal, centre) + 2.0 * plane.offset;
            const double reach = glm::dot(glm::abs(plane.normal), extent);
            if (middle + reach < 0.0) return false;
            if (middle - reach >= 0.0) which &= ~(1U << i);
        }
        return true;
    }
    struct Ray {
        Ray(const dvec3& origin, const dvec3& direction) noexcept;
        dvec3 from{0.0};
        dvec3 inverse{0.0};  ///< of the direction
        bool along[3] = {};  ///< the direction goes along this axis at all
    };
    static bool passes(const Box& box, const Ray& ray, double& entry, double& exit) noexcept {
        entry = 0.0;
        exit = std::numeric_limits<double>::infinity();
        if (box.empty()) return false;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = box.min[axis] - ray.from[axis];
            const double high = box.max[axis] - ray.from[axis];
            if (!ray.along[axis]) {
                if (!(low <= 0.0 && high >= 0.0)) return false;
                continue;
            }
            const double a = low * ray.inverse[axis];
            const double b = high * ray.inverse[axis];
            entry = std::max(entry, std::min(a, b));
            exit = std::min(exit, std::max(a, b));
        }
        return entry <= exit;
    }
    struct Middle;

    void rebuild();
    std::uint32_t buildNode(std::span<Middle> items, std::uint32_t parent);
    Box boxOf(const Node& node, std::uint32_t index) const noexcept;
    double looseness() const noexcept;

    std::vector<Box> boxes_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> leafOf_;
    std::vector<std::uint32_t> dirty_;
    double built_ = 0.0;  ///< looseness when built
    std::size_t movedSince_ = 0;
};

}  // namespace gnomon::math
