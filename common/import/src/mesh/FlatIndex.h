#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace gnomon::importer {

/// Finds equal items among many: open addressing, linear probing, at most half full. Holds item
/// numbers only; the caller compares.
class FlatIndex {
public:
    static constexpr std::uint32_t none = 0xffffffffU;

    explicit FlatIndex(std::size_t items)
        : slots_(std::bit_ceil(items * 2 + 2)), mask_{slots_.size() - 1} {}

    /// The item that equal() accepts, or @p item, which is then kept.
    template <class Equal>
    std::uint32_t findOrAdd(std::uint64_t hash, std::uint32_t item, Equal&& equal) {
        const auto tag = static_cast<std::uint32_t>(hash >> 32U);
        for (std::size_t at = static_cast<std::size_t>(hash) & mask_;; at = (at + 1) & mask_) {
            Slot& slot = slots_[at];
            if (slot.item == none) {
                slot = {.item = item, .tag = tag};
                return item;
            }
            if (slot.tag == tag && equal(slot.item)) return slot.item;
        }
    }

private:
    struct Slot {
        std::uint32_t item = none;
        std::uint32_t tag = 0;
    };
    std::vector<Slot> slots_;
    std::size_t mask_;
};

/// Multiply-and-fold over 32-bit words; good enough for tables, no guard against an attacker.
class WordHash {
public:
    void add(std::uint32_t word) noexcept {
        state_ = (state_ ^ word) * 0x9e3779b97f4a7c15ULL;
        state_ ^= state_ >> 29U;
    }
    /// An object of a multiple of four bytes.
    template <class T>
    void addObject(const T& object) noexcept {
        static_assert(sizeof(T) % 4 == 0);
        std::uint32_t words[sizeof(T) / 4];
        std::memcpy(words, &object, sizeof(T));
        for (const std::uint32_t word : words) add(word);
    }
    std::uint64_t value() const noexcept {
        const std::uint64_t mixed = state_ * 0xff51afd7ed558ccdULL;
        return mixed ^ (mixed >> 32U);
    }

private:
    std::uint64_t state_ = 0x2545f4914f6cdd1dULL;
};

}  // namespace gnomon::importer
