#include "mesh/Chunks.h"

#include <algorithm>
#include <limits>

namespace gnomon::importer {
namespace {

struct Item {
    math::vec3 centroid;
    std::uint32_t primitive = 0;
};

struct Part {
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t chunks = 0;  ///< how many it is to become
};

int longestAxis(std::span<const Item> items) {
    math::vec3 min{std::numeric_limits<float>::max()};
    math::vec3 max{-std::numeric_limits<float>::max()};
    for (const Item& item : items) {
        min = glm::min(min, item.centroid);
        max = glm::max(max, item.centroid);
    }
    const math::vec3 size = max - min;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

/// Reorders items so that each of the returned parts lies together in space.
std::vector<Part> split(std::vector<Item>& items) {
    std::vector<Part> done;
    std::vector<Part> open;
    if (!items.empty())
        open.push_back({.last = items.size(), .chunks = (items.size() - 1) / chunkSize + 1});
    while (!open.empty()) {
        const Part part = open.back();
        open.pop_back();
        const auto begin = items.begin() + static_cast<std::ptrdiff_t>(part.first);
        const auto end = items.begin() + static_cast<std::ptrdiff_t>(part.last);
        if (part.chunks == 1) {
            std::sort(begin, end,
                      [](const Item& a, const Item& b) { return a.primitive < b.primitive; });
            done.push_back(part);
            continue;
        }
        const int axis = longestAxis({begin, end});
        const std::size_t chunksLeft = part.chunks / 2;
        const std::size_t count = part.last - part.first;
        const std::size_t middle = part.first + count * chunksLeft / part.chunks;
        // Ties by number: the same file gives the same chunks everywhere.
        std::nth_element(begin, items.begin() + static_cast<std::ptrdiff_t>(middle), end,
                         [axis](const Item& a, const Item& b) {
                             const float x = a.centroid[axis];
                             const float y = b.centroid[axis];
                             return x != y ? x < y : a.primitive < b.primitive;
                         });
        open.push_back({middle, part.last, part.chunks - chunksLeft});
        open.push_back({part.first, middle, chunksLeft});
    }
    return done;
}

}  // namespace

std::vector<scene::Chunk> cutIntoChunks(std::span<const math::vec3> positions,
                                        std::vector<std::uint32_t>& indices, std::size_t corners,
                                        const std::vector<bool>& closed) {
    const std::size_t count = indices.size() / corners;
    std::vector<scene::Chunk> chunks;
    std::vector<std::uint32_t> ordered;
    ordered.reserve(count * corners);
    for (const bool wanted : {true, false}) {
        if (wanted && closed.empty()) continue;
        std::vector<Item> items;
        for (std::size_t i = 0; i < count; ++i) {
            if (!closed.empty() && closed[i] != wanted) continue;
            math::vec3 sum{0.0F};
            for (std::size_t k = 0; k < corners; ++k) sum += positions[indices[i * corners + k]];
            items.push_back({sum / static_cast<float>(corners), static_cast<std::uint32_t>(i)});
        }
        for (const Part& part : split(items)) {
            scene::Chunk chunk;
            chunk.firstIndex = static_cast<std::uint32_t>(ordered.size());
            chunk.closed = wanted;
            chunk.min = chunk.max = positions[indices[items[part.first].primitive * corners]];
            for (std::size_t i = part.first; i < part.last; ++i) {
                for (std::size_t k = 0; k < corners; ++k) {
                    const auto index = indices[items[i].primitive * corners + k];
                    ordered.push_back(index);
                    chunk.min = glm::min(chunk.min, positions[index]);
                    chunk.max = glm::max(chunk.max, positions[index]);
                }
            }
            chunk.indexCount = static_cast<std::uint32_t>(ordered.size()) - chunk.firstIndex;
            chunks.push_back(chunk);
        }
    }
    indices = std::move(ordered);
    return chunks;
}

}  // namespace gnomon::importer
