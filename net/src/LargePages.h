#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::net {

/// Reserves, and asks the system for pages of 2 MiB: to fault in a large buffer in pages of 4 KiB
/// takes longer than to receive it.
inline void reserveInLargePages(std::vector<std::byte>& bytes, std::size_t size) {
    constexpr std::uintptr_t page = std::uintptr_t{2} << 20U;
    bytes.reserve(size);
    const auto begin = (reinterpret_cast<std::uintptr_t>(bytes.data()) + page - 1) & ~(page - 1);
    const auto end =
        reinterpret_cast<std::uintptr_t>(bytes.data() + bytes.capacity()) & ~(page - 1);
    // Where the system knows none, nothing is lost.
    if (begin < end)
        ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // NOLINT
}

}  // namespace gnomon::net
