#pragma once

#include <gnomon/net/ServerEvent.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

namespace gnomon::net {

/// A client's schema to be agreed on: done by the main thread, which owns the type registry.
struct SchemaOffer {
    std::uint64_t session = 0;
    std::string who = {};
    std::vector<std::byte> schema = {};
};

/// The way from the server's sockets to its main thread. Locked, for the helper thread fills it,
/// too, and anybody may push a Quit.
class Inbox {
public:
    using Item = std::variant<ServerEvent, SchemaOffer>;

    void push(Item item, std::size_t bytes) {
        const std::lock_guard lock{mutex_};
        items_.push_back({std::move(item), bytes});
        bytes_ += bytes;
    }

    /// What a session left unread means nothing to the next one. Keeps a Quit.
    void dropSession() {
        const std::lock_guard lock{mutex_};
        std::erase_if(items_, [](const Entry& entry) {
            const auto* event = std::get_if<ServerEvent>(&entry.item);
            return event == nullptr || !(std::holds_alternative<Quit>(*event) ||
                                         std::holds_alternative<ClientLeft>(*event));
        });
        bytes_ = 0;
    }

    bool empty() const {
        const std::lock_guard lock{mutex_};
        return items_.empty();
    }

    std::optional<Item> pop() {
        const std::lock_guard lock{mutex_};
        if (items_.empty()) return {};
        Entry entry = std::move(items_.front());
        items_.pop_front();
        bytes_ -= std::min(bytes_, entry.bytes);
        return std::move(entry.item);
    }

    std::size_t bytes() const {
        const std::lock_guard lock{mutex_};
        return bytes_;
    }

    Queued peek() const {
        const std::lock_guard lock{mutex_};
        Queued queued;
        for (const Entry& entry : items_) {
            const auto* event = std::get_if<ServerEvent>(&entry.item);
            if (event == nullptr) continue;
            if (const auto* frame = std::get_if<Frame>(event)) queued.newestFrame = frame->n;
            if (const auto* swap = std::get_if<Swap>(event)) queued.newestSwap = swap->n;
            queued.clientLeft |= std::holds_alternative<ClientLeft>(*event);
            queued.quit |= std::holds_alternative<Quit>(*event);
        }
        return queued;
    }

    /// Whether the core wants to be told when something was taken.
    bool throttled() const noexcept { return throttled_.load(); }
    void setThrottled(bool on) noexcept { throttled_ = on; }

private:
    struct Entry {
        Item item;
        std::size_t bytes = 0;
    };
    mutable std::mutex mutex_;
    std::deque<Entry> items_;
    std::size_t bytes_ = 0;
    std::atomic<bool> throttled_{false};
};

}  // namespace gnomon::net
