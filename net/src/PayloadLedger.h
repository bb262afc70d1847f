#pragma once

#include <gnomon/field/ChangeList.h>
#include <gnomon/net/ClientMessages.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace gnomon::net {

/// Which payloads every connected server has, or has coming. Each is uploaded once; one that was
/// released and comes back is uploaded again, under another serial.
class PayloadLedger {
public:
    struct Kept {
        field::Payload payload = {};
        std::uint64_t serial = 0;
        std::uint64_t frame = 0;  ///< that needed it first
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
    std::vector<wire::PayloadRelease> release(const std::vector<field::Hash128>& unused) {
        std::vector<wire::PayloadRelease> released;
        for (const field::Hash128& hash : unused) {
            const auto found = kept_.find(hash);
            if (found == kept_.end()) continue;  // of a container that is not replicated
            released.push_back({.hash = hash, .serial = found->second.serial});
            kept_.erase(found);
        }
        return released;
    }
    /// What frames after @p n needed first, 0: all; in the order of the serials.
    std::vector<Kept> since(std::uint64_t n) const {
        std::vector<Kept> list;
        for (const auto& [hash, kept] : kept_)
            if (kept.frame > n) list.push_back(kept);
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
    std::uint64_t serial_ = 0;
};

}  // namespace gnomon::net
