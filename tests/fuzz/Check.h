#pragma once

#include <cstdio>
#include <cstdlib>

namespace gnomon::fuzz {

/// A claim about any input at all: libFuzzer keeps the input that breaks it.
inline void require(bool holds, const char* claim) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", claim);
    std::abort();
}

}  // namespace gnomon::fuzz
