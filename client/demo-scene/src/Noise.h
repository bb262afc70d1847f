#pragma once

#include <cstdint>

namespace gnomon::demo {

/// Gradient noise that repeats, for textures that tile.
///
/// Source: Ken Perlin. Improving Noise. SIGGRAPH 2002. Here the lattice wraps after a whole
/// number of cells, and the gradients come from a hash of the seed instead of a table.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : seed_{seed} {}

    /// About -1 to 1, repeating every 1 in u and v, with @p cells lattice cells a repeat.
    float at(float u, float v, int cellsU, int cellsV) const;
    float at(float u, float v, int cells) const { return at(u, v, cells, cells); }

    /// Sum of @p octaves, each of half the size and half the strength of the one before.
    float fractal(float u, float v, int cells, int octaves) const;
    float fractal(float u, float v, int cellsU, int cellsV, int octaves) const;

    /// In [0, 1), the same for the same whole numbers.
    float cell(int i, int j) const;

private:
    std::uint32_t hash(int i, int j) const;
    std::uint64_t seed_;
};

}  // namespace gnomon::demo
