#pragma once

#include <gnomon/field/FieldContainer.h>
#include <gnomon/field/Id.h>

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace gnomon::field {

/// An aspect's containers by id.
///
/// Ids of a space are counted up, and what is made together changes together. So they lie in pages
/// of neighbours, and who looks up one after the other (see Cursor) finds the next one without
/// hashing. A page holds few, so that ids sown far apart by a hostile sender cost little.
class ContainerTable {
    static constexpr int pageBits = 5;
    static constexpr std::uint64_t slotMask = (std::uint64_t{1} << pageBits) - 1;
    struct Page {
        std::array<std::unique_ptr<FieldContainer>, slotMask + 1> slots = {};
        std::uint32_t used = 0;
    };

public:
    /// Looks up many; knows the page of the last one. Ends with the next insertion or removal.
    class Cursor {
    public:
        explicit Cursor(const ContainerTable& table) : table_{table} {}
        FieldContainer* find(Id id) noexcept {
            const std::uint64_t key = id.value >> pageBits;
            if (page_ == nullptr || key != key_) {
                page_ = table_.pageOf(id);
                key_ = key;
                if (page_ == nullptr) return nullptr;
            }
            return page_->slots[id.value & slotMask].get();
        }

    private:
        const ContainerTable& table_;
        const Page* page_ = nullptr;
        std::uint64_t key_ = 0;
    };

    /// nullptr where there is none.
    FieldContainer* find(Id id) const noexcept {
        const Page* page = pageOf(id);
        return page == nullptr ? nullptr : page->slots[id.value & slotMask].get();
    }
    std::size_t size() const noexcept { return size_; }

    /// Takes it in under its id, which must be free.
    void insert(Id id, std::unique_ptr<FieldContainer> container) {
        Page& page = pages_[id.value >> pageBits];
        page.slots[id.value & slotMask] = std::move(container);
        ++page.used;
        ++size_;
    }
    /// One that is there.
    void erase(Id id) {
        const auto found = pages_.find(id.value >> pageBits);
        // Alive until the table is in order again: its destructor may look things up.
        const auto gone = std::move(found->second.slots[id.value & slotMask]);
        --size_;
        if (--found->second.used == 0) pages_.erase(found);
    }
    /// In no order.
    template <class Fn>
    void forEach(Fn&& fn) const {
        for (const auto& [key, page] : pages_)
            for (const auto& container : page.slots)
                if (container) fn(*container);
    }

private:
    const Page* pageOf(Id id) const noexcept {
        const auto found = pages_.find(id.value >> pageBits);
        return found == pages_.end() ? nullptr : &found->second;
    }

    std::unordered_map<std::uint64_t, Page> pages_;
    std::size_t size_ = 0;
};

}  // namespace gnomon::field
