#pragma once

#include <gnomon/math/Types.h>
#include <gnomon/scene/Geometry.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::importer {

/// Triangles (lines, points) a chunk holds at most.
inline constexpr std::size_t chunkSize = 1024;

/// Cuts primitives into spatial chunks: recursive median split of their centroids along the longest
/// axis, into chunks of nearly equal size. Closed and other triangles never share a chunk.
/// @param indices  reordered by chunk; within a chunk the order stays
/// @param closed   one a primitive; empty: none is
std::vector<scene::Chunk> cutIntoChunks(std::span<const math::vec3> positions,
                                        std::vector<std::uint32_t>& indices, std::size_t corners,
                                        const std::vector<bool>& closed);

}  // namespace gnomon::importer
