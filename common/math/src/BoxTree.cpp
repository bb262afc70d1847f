#include <gnomon/math/BoxTree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

void BoxTree::rebuild() {
    nodes_.clear();
    dirty_.clear();
    order_.resize(boxes_.size());
    leafOf_.resize(boxes_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(boxes_.size());
    if (!boxes_.empty()) buildNode(0, static_cast<std::uint32_t>(boxes_.size()), 0);
    built_ = looseness();
    movedSince_ = 0;
}

std::uint32_t BoxTree::buildNode(std::uint32_t first, std::uint32_t last, std::uint32_t parent) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({.first = first, .count = last - first, .parent = parent});
    Box box;
    Box centres;
    for (std::uint32_t i = first; i < last; ++i) {
        const Box& item = boxes_[order_[i]];
        if (item.empty()) continue;
        box.add(item);
        centres.add(item.centre());
    }
    nodes_[index].box = box;
    if (last - first <= leafItems) {
        for (std::uint32_t i = first; i < last; ++i) leafOf_[order_[i]] = index;
        return index;
    }
    // Halves by number: balanced whatever the boxes are, empty ones too.
    const dvec3 size = centres.empty() ? dvec3{0.0} : centres.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (last - first) / 2;
    const auto key = [&](std::uint32_t item) {
        const double twice = boxes_[item].min[axis] + boxes_[item].max[axis];
        // Of a box from minus to plus infinity no number: an order must not see it.
        return boxes_[item].empty() || std::isnan(twice) ? 0.0 : twice;
    };
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double x = key(a);
                         const double y = key(b);
                         return x < y || (x == y && a < b);
                     });
    nodes_[index].count = 0;
    buildNode(first, middle, index);
    const std::uint32_t second = buildNode(middle, last, index);
    nodes_[index].second = second;
    return index;
}

Box BoxTree::boxOf(const Node& node, std::uint32_t index) const noexcept {
    Box box;
    if (node.count == 0) {
        box = nodes_[index + 1].box;
        box.add(nodes_[node.second].box);
        return box;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) box.add(boxes_[order_[node.first + i]]);
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
