#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace gnomon::render {

/// First-fit ranges of a line of `capacity` elements.
class RangeAllocator {
public:
    std::uint32_t capacity() const noexcept { return capacity_; }
    void grow(std::uint32_t capacity) {
        give(capacity_, capacity - capacity_);
        capacity_ = capacity;
    }
    std::optional<std::uint32_t> take(std::uint32_t count) {
        for (auto at = free_.begin(); at != free_.end(); ++at) {
            if (at->second < count) continue;
            const auto [start, size] = *at;
            free_.erase(at);
            if (size > count) free_.emplace(start + count, size - count);
            return start;
        }
        return std::nullopt;
    }
    void give(std::uint32_t start, std::uint32_t count) {
        if (count == 0) return;
        auto next = free_.lower_bound(start);
        if (next != free_.begin()) {
            const auto before = std::prev(next);
            if (before->first + before->second == start) {
                start = before->first;
                count += before->second;
                free_.erase(before);
            }
        }
        if (next != free_.end() && start + count == next->first) {
            count += next->second;
            free_.erase(next);
        }
        free_.emplace(start, count);
    }

private:
    std::uint32_t capacity_ = 0;
    std::map<std::uint32_t, std::uint32_t> free_;  // start -> size
};

}  // namespace gnomon::render
