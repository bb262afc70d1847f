#pragma once

#include <gnomon/field/ChangeList.h>
#include <gnomon/net/ClientMessages.h>

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace gnomon::net {

/// Which payloads every connected server has, or has coming. Each is uploaded once; one that was
/// released and comes back is uploaded again, under another serial.
///
/// What a frame released is held a while longer: those who get their payloads from another server
/// may lose it before they have what the frames before that one needed.
class PayloadLedger {
public:
    struct Kept {
        field::Payload payload = {};
        std::uint64_t serial = 0;
        std::uint64_t frame = 0;     ///< that needed it first
        std::uint64_t released = 0;  ///< by this frame; 0: in use
    };

    /// What the list of frame @p n names, each once; appends to @p fresh what the servers do not
    /// have.
    std::vector<wire::PayloadName> take(const field::ChangeList& list, std::uint64_t n,
                                        std::vector<Kept>& fresh) {
        std::vector<wire::PayloadName> needed;
        std::unordered_set<field::Hash128> seen;
        for (const field::Payload& payload : list.payloads) {
            if (!payload || !seen.insert(payload.hash()).second) continue;
            needed.push_back({.hash = payload.hash(), .size = payload.size()});
            const auto [at, isNew] = kept_.try_emplace(payload.hash());
            if (!isNew) continue;
            at->second = {.payload = payload, .serial = ++serial_, .frame = n};
            fresh.push_back(at->second);
        }
        return needed;
    }
    /// By frame @p n. @param hold  see `forget`
    std::vector<wire::PayloadRelease> release(const std::vector<field::Hash128>& unused,
                                              std::uint64_t n, bool hold) {
        std::vector<wire::PayloadRelease> released;
        for (const field::Hash128& hash : unused) {
            const auto found = kept_.find(hash);
            if (found == kept_.end()) continue;  // of a container that is not replicated
            released.push_back({.hash = hash, .serial = found->second.serial});
            if (hold) {
                found->second.released = n;
                held_.push_back(std::move(found->second));
            }
            kept_.erase(found);
        }
        return released;
    }
    /// What was released by frames up to @p n is not held any longer.
    void forget(std::uint64_t n) {
        while (!held_.empty() && held_.front().released <= n) held_.pop_front();
    }
    bool holdsAny() const noexcept { return !held_.empty(); }
    /// What frames after @p n needed first, 0: all that is in use; in the order of the serials.
    /// @param begun  the frame up to which all was applied: what was released later is among them
    std::vector<Kept> since(std::uint64_t n, std::uint64_t begun) const {
        std::vector<Kept> list;
        for (const auto& [hash, kept] : kept_)
            if (kept.frame > n) list.push_back(kept);
        for (const Kept& kept : held_)
            if (kept.frame > n && kept.released > begun) list.push_back(kept);
        std::sort(list.begin(), list.end(),
                  [](const Kept& a, const Kept& b) { return a.serial < b.serial; });
        return list;
    }
    std::vector<wire::PayloadName> names() const {
        std::vector<wire::PayloadName> list;
        list.reserve(kept_.size());
        for (const auto& [hash, kept] : kept_)
            list.push_back({.hash = hash, .size = kept.payload.size()});
        return list;
    }
    /// Of the newest upload.
    std::uint64_t newest() const noexcept { return serial_; }

private:
    std::unordered_map<field::Hash128, Kept> kept_;
    std::deque<Kept> held_;  // by the frame that released them
    std::uint64_t serial_ = 0;
};

}  // namespace gnomon::net
