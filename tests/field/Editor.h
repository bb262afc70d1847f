#pragma once

#include <algorithm>

#include "TestTypes.h"

namespace gnomon::field::test {

/// Edits an aspect at random: every kind of field, creations, destructions.
class Editor {
public:
    Editor(Aspect& aspect, unsigned seed) : aspect_{aspect}, random_{seed} {}

    void step() {
        if (items_.size() < 4 || pick(8) == 0) {
            items_.push_back(&aspect_.create<Item>());
            return;
        }
        const Item& item = any();
        if (pick(12) == 0) {
            destroy(item);
            return;
        }
        auto e = edit(item);
        const auto value = static_cast<std::int32_t>(random_());
        switch (pick(14)) {
            case 0:
                e->on = !e->on;
                break;
            case 1:
                e->level = static_cast<std::uint8_t>(value);
                break;
            case 2:
                e->number = value;
                break;
            case 3:
                e->weight = value * 0.25;
                break;
            case 4:
                e->name = word();
                break;
            case 5:
                e->colour = static_cast<Colour>(pick(3));
                break;
            case 6:
                e->next = pick(3) == 0 ? Ref<Item>{} : Ref<Item>{any()};
                break;
            case 7:
                e->data = payloadOf(word());
                break;
            case 8:
                e->numbers.pushBack(value);
                break;
            case 9:
                e->words.insert(pick(e->words.size() + 1), word());
                break;
            case 10:
                e->links.pushBack(any());
                break;
            case 11:
                e->blobs.pushBack(payloadOf(word()));
                break;
            case 12:
                if (!e->links.empty()) e->links.erase(pick(e->links.size()));
                break;
            default:
                if (!e->blobs.empty()) e->blobs.set(pick(e->blobs.size()), payloadOf(word()));
                break;
        }
    }
    void steps(int count) {
        for (int i = 0; i < count; ++i) step();
    }

private:
    std::size_t pick(std::size_t below) { return random_() % below; }
    const Item& any() { return *items_[pick(items_.size())]; }
    std::string word() { return std::string(pick(9), static_cast<char>('a' + pick(26))); }
    void destroy(const Item& item) {
        if (item.references() > 0) return;
        std::erase(items_, &item);
        expectApplied(aspect_.destroy(item));
    }

    Aspect& aspect_;
    std::mt19937 random_;
    std::vector<const Item*> items_;
};

}  // namespace gnomon::field::test
