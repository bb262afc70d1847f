#include <gnomon/math/BoxTree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::math {
namespace {

constexpr std::uint32_t leafItems = 4;

double halfArea(const Box& box) noexcept {
    if (box.empty()) return 0.0;
    const dvec3 s = box.size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

}  // namespace

void BoxTree::build(std::vector<Box> boxes) {
    boxes_ = std::move(boxes);
    rebuild();
}

bool BoxTree::any(std::span<const Plane> planes) const noexcept {
    if (nodes_.empty()) return false;
    std::uint32_t open[64];
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = open[--count];
        const Node& node = nodes_[index];
        std::uint32_t left = allOf(planes);
        if (!cut(node.box, planes, left)) continue;
        if (left == 0) return true;
        if (node.count == 0) {
            open[count++] = node.second;
            open[count++] = index + 1;
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            left = allOf(planes);
            if (cut(boxes_[order_[node.first + i]], planes, left)) return true;
        }
    }
    return false;
}

BoxTree::Ray::Ray(const dvec3& origin, const dvec3& direction) noexcept : from{origin} {
    for (int axis = 0; axis < 3; ++axis) {
        along[axis] = std::abs(direction[axis]) > 1e-300;
        inverse[axis] = along[axis] ? 1.0 / direction[axis] : 0.0;
    }
}

/// The middle of a box, twice, beside the box's place: what is sorted lies together.
struct BoxTree::Middle {
    dvec3 twice{0.0};
    std::uint32_t item = 0;
    bool counts = false;  ///< the box is not empty
};

void BoxTree::rebuild() {
    nodes_.clear();
    dirty_.clear();
    leafOf_.resize(boxes_.size());
    nodes_.reserve(boxes_.size());
    std::vector<Middle> middles(boxes_.size());
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        Middle& middle = middles[i];
        middle.item = i;
        if (boxes_[i].empty()) continue;
        middle.counts = true;
        middle.twice = boxes_[i].min + boxes_[i].max;
        // Of a box from minus to plus infinity no number: an order must not see it.
        for (int axis = 0; axis < 3; ++axis)
            if (std::isnan(middle.twice[axis])) middle.twice[axis] = 0.0;
    }
    order_.clear();
    order_.reserve(boxes_.size());
    if (!boxes_.empty()) buildNode(middles, 0);
    built_ = looseness();
    movedSince_ = 0;
}

std::uint32_t BoxTree::buildNode(std::span<Middle> items, std::uint32_t parent) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({.parent = parent});
    if (items.size() <= leafItems) {
        nodes_[index].first = static_cast<std::uint32_t>(order_.size());
        nodes_[index].count = static_cast<std::uint32_t>(items.size());
        for (const Middle& middle : items) {
            leafOf_[middle.item] = index;
            order_.push_back(middle.item);
        }
        nodes_[index].box = boxOf(nodes_[index], index);
        return index;
    }
    // Halves by number: balanced whatever the boxes are, empty ones too.
    Box middles;
    for (const Middle& middle : items)
        if (middle.counts) middles.add(middle.twice);
    const dvec3 size = middles.empty() ? dvec3{0.0} : middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto half = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [axis](const Middle& a, const Middle& b) {
                         const double x = a.twice[axis];
                         const double y = b.twice[axis];
                         return x < y || (x == y && a.item < b.item);
                     });
    buildNode(items.first(half), index);
    nodes_[index].second = buildNode(items.subspan(half), index);
    nodes_[index].box = boxOf(nodes_[index], index);
    return index;
}

Box BoxTree::boxOf(const Node& node, std::uint32_t index) const noexcept {
    Box box;
    if (node.count == 0) {
        box = nodes_[index + 1].box;
        box.add(nodes_[node.second].box);
        return box;
    }
    for (std::uint32_t i = 0; i < node.count; ++i)
        if (const Box& item = boxes_[order_[node.first + i]]; !item.empty()) box.add(item);
    return box;
}

void BoxTree::move(std::uint32_t item, const Box& box) {
    boxes_[item] = box;
    dirty_.push_back(leafOf_[item]);
}

void BoxTree::refit() {
    if (dirty_.empty()) return;
    movedSince_ += dirty_.size();
    // Many paths to the root cost more than one sweep from the leaves up.
    if (dirty_.size() * 8 > nodes_.size()) {
        for (std::size_t i = nodes_.size(); i-- > 0;)
            nodes_[i].box = boxOf(nodes_[i], static_cast<std::uint32_t>(i));
    } else {
        for (std::uint32_t index : dirty_) {
            for (;;) {
                const Box box = boxOf(nodes_[index], index);
                if (box == nodes_[index].box) break;
                nodes_[index].box = box;
                if (index == 0) break;
                index = nodes_[index].parent;
            }
        }
    }
    dirty_.clear();
    if (movedSince_ < boxes_.size()) return;
    movedSince_ = 0;
    if (looseness() > 1.5 * built_) rebuild();
}

double BoxTree::looseness() const noexcept {
    double sum = 0.0;
    for (const Node& node : nodes_) sum += halfArea(node.box);
    return sum;
}

}  // namespace gnomon::math
