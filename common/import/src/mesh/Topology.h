#pragma once

#include <gnomon/math/Types.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::importer {

/// For each vertex the first one at exactly the same place (0 and -0 are the same).
std::vector<std::uint32_t> weldedPositions(std::span<const math::vec3> positions);

/// For each triangle, whether it belongs to a closed surface: a set of triangles connected by
/// edges, each edge shared by exactly two of them that run along it in opposite directions.
/// Triangles with two equal corners belong to none and are not looked at.
/// @param corners  three a triangle, welded: equal numbers are equal places
/// @param vertexCount  above every corner
std::vector<bool> closedTriangles(std::span<const std::uint32_t> corners, std::size_t vertexCount);

/// Which of @p count items lie at which key: a counting sort. Items of key k are
/// items[first[k]] .. items[first[k + 1]], ascending.
struct Buckets {
    std::vector<std::uint32_t> first = {};
    std::vector<std::uint32_t> items = {};
    std::span<const std::uint32_t> of(std::uint32_t key) const noexcept {
        return std::span{items}.subspan(first[key], first[key + 1] - first[key]);
    }
};
Buckets sortedIntoBuckets(std::span<const std::uint32_t> keys, std::size_t keyCount);

}  // namespace gnomon::importer
