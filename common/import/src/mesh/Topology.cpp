#include "mesh/Topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "mesh/FlatIndex.h"

namespace gnomon::importer {
namespace {

class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t find(std::uint32_t item) noexcept {
        while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
        return item;
    }
    void join(std::uint32_t a, std::uint32_t b) noexcept {
        a = find(a);
        b = find(b);
        // The smaller number leads: no ranks needed, paths are halved anyway.
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// One triangle's use of an edge, kept with the edge's lower vertex.
struct EdgeUse {
    std::uint32_t other = 0;  ///< the edge's higher vertex
    std::uint32_t triangle = 0;
    bool upward = false;  ///< runs from the lower to the higher vertex
};

bool isDegenerate(const std::uint32_t* t) noexcept {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

std::vector<std::uint32_t> weldedPositions(std::span<const math::vec3> positions) {
    std::vector<std::uint32_t> welded(positions.size());
    FlatIndex index{positions.size()};
    // Compared by bits, after -0 + 0 has become 0: NaN, which never equals itself, would fill the
    // table with entries of one hash.
    const auto bits = [&](std::uint32_t i) {
        const auto& p = positions[i];
        return std::array{std::bit_cast<std::uint32_t>(p.x + 0.0F),
                          std::bit_cast<std::uint32_t>(p.y + 0.0F),
                          std::bit_cast<std::uint32_t>(p.z + 0.0F)};
    };
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const auto own = bits(i);
        WordHash hash;
        hash.addObject(own);
        welded[i] = index.findOrAdd(hash.value(), i,
                                    [&](std::uint32_t other) { return bits(other) == own; });
    }
    return welded;
}

Buckets sortedIntoBuckets(std::span<const std::uint32_t> keys, std::size_t keyCount) {
    Buckets buckets;
    buckets.first.resize(keyCount + 1);
    for (const auto key : keys) ++buckets.first[key + 1];
    std::partial_sum(buckets.first.begin(), buckets.first.end(), buckets.first.begin());
    buckets.items.resize(keys.size());
    auto next = buckets.first;
    for (std::uint32_t i = 0; i < keys.size(); ++i) buckets.items[next[keys[i]]++] = i;
    return buckets;
}

std::vector<bool> closedTriangles(std::span<const std::uint32_t> corners, std::size_t vertexCount) {
    const std::size_t triangles = corners.size() / 3;
    // Half edge 3 t + k runs from corner k of triangle t to the next; its key is its lower vertex.
    std::vector<std::uint32_t> lower(triangles * 3);
    const auto end = [&](std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; };
    for (std::uint32_t half = 0; half < lower.size(); ++half)
        lower[half] = std::min(corners[half], corners[end(half)]);
    const Buckets byLower = sortedIntoBuckets(lower, vertexCount);

    UnionFind surfaces{triangles};
    std::vector<bool> torn(triangles);  // has an edge that is not shared as it should be
    std::vector<EdgeUse> uses;
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex) {
        uses.clear();
        for (const auto half : byLower.of(vertex)) {
            const auto triangle = half / 3;
            if (isDegenerate(&corners[std::size_t{triangle} * 3])) continue;
            const bool upward = corners[half] == vertex;
            uses.push_back({.other = upward ? corners[end(half)] : corners[half],
                            .triangle = triangle,
                            .upward = upward});
        }
        std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
            return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
        });
        for (std::size_t i = 0; i < uses.size();) {
            std::size_t next = i + 1;
            while (next < uses.size() && uses[next].other == uses[i].other) ++next;
            const bool sound = next - i == 2 && uses[i].upward != uses[i + 1].upward;
            for (; i < next; ++i) {
                surfaces.join(uses[next - 1].triangle, uses[i].triangle);
                if (!sound) torn[uses[i].triangle] = true;
            }
        }
    }

    std::vector<bool> tornSurface(triangles);
    for (std::uint32_t t = 0; t < triangles; ++t)
        if (torn[t]) tornSurface[surfaces.find(t)] = true;
    std::vector<bool> closed(triangles);
    for (std::uint32_t t = 0; t < triangles; ++t)
        closed[t] = !isDegenerate(&corners[std::size_t{t} * 3]) && !tornSurface[surfaces.find(t)];
    return closed;
}

}  // namespace gnomon::importer
