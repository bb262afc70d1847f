#pragma once

#include <gnomon/field/Id.h>
#include <gnomon/field/Payload.h>
#include <gnomon/field/Type.h>

#include <cstddef>
#include <vector>

namespace gnomon::field {

/// What happened to an aspect between two commits. Self-contained: it can be applied by another
/// thread while its source is edited on. The same bytes go to the servers.
///
/// On the wire, any number of blocks, each:
///   u8 version (1), u32 creations, u32 changes, u32 releases,
///   creations: u32 type, u64 id;
///   changes:   u64 id, u32 mask, the masked fields in table order;
///   releases:  u64 id.
/// Little-endian. All creations come before all changes before all releases of a block.
struct ChangeList {
    static constexpr std::uint8_t version = 1;

    std::vector<std::byte> bytes = {};
    /// Every payload the bytes name that the receiver may not have. Not part of the bytes.
    std::vector<Payload> payloads = {};

    bool empty() const noexcept { return bytes.empty(); }
    /// Everything of @p later happens after everything here.
    void append(const ChangeList& later) {
        bytes.insert(bytes.end(), later.bytes.begin(), later.bytes.end());
        payloads.insert(payloads.end(), later.payloads.begin(), later.payloads.end());
    }
};

/// What applying a change list did, for whoever keeps something derived from the containers.
struct Applied {
    struct Change {
        Id id = {};
        Mask mask = 0;
    };
    std::vector<Id> created = {};
    std::vector<Change> changed = {};  ///< also of containers just created
    std::vector<Id> destroyed = {};

    bool empty() const noexcept { return created.empty() && changed.empty() && destroyed.empty(); }
    void clear() {
        created.clear();
        changed.clear();
        destroyed.clear();
    }
};

}  // namespace gnomon::field
