#pragma once

#include <cstdint>
#include <random>

namespace gnomon::net {

/// A number that nobody else has and nobody can guess.
inline std::uint64_t randomToken() {
    std::random_device source;
    return (std::uint64_t{source()} << 32U) | source();
}

}  // namespace gnomon::net
