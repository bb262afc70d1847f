// Whether the servers' copies are the session's, and where not, in what.
#include <fmt/format.h>

#include <algorithm>

#include "HubCore.h"

namespace gnomon::net {
namespace {

constexpr std::size_t mostNamed = 3;

}  // namespace

void HubCore::noteDigest(std::uint64_t n) {
    digests_[n] = session_.digest();
    while (digests_.size() > 4) digests_.erase(digests_.begin());
}

void HubCore::noteDigests(std::uint64_t n) {
    eachDigest_[n] = session_.digests();
    while (eachDigest_.size() > 2) eachDigest_.erase(eachDigest_.begin());
}

void HubCore::digest(Peer& peer, const Digest& digest) {
    const auto found = digests_.find(digest.n);
    if (found == digests_.end() || found->second == digest.digest) return;
    peer.standing.drifting = true;
    if (peer.driftNamed) return;
    log(LogLevel::error,
        fmt::format("{}: its copy of the scene drifted: digest {:016x} after frame {}, expected "
                    "{:016x}",
                    peer.label(), digest.digest, digest.n, found->second));
    anyDrifts_ = true;
}

/// Names what differs, and lets the server begin anew. Only once: a copy that drifts again and
/// again is not mended by that, and a wall that flickers is worse than one that is slightly wrong.
void HubCore::digests(Peer& peer, const Digests& theirs) {
    if (!peer.standing.drifting || peer.driftNamed || !eachDigest_.contains(theirs.n)) return;
    peer.driftNamed = true;
    const auto what = differences(theirs);
    log(LogLevel::error,
        fmt::format("{}: after frame {} {}", peer.label(), theirs.n,
                    what.empty() ? "its containers are as they should be again" : what));
    if (!what.empty())
        peer.drop({.code = Errc::protocol,
                   .what = peer.label() + ": dropped at frame " + std::to_string(theirs.n) +
                           " to begin anew with the session's copy"});
}

std::string HubCore::differences(const Digests& theirs) const {
    const auto& ours = eachDigest_.at(theirs.n);
    std::size_t count = 0;
    std::string named;
    const auto differs = [&](field::Id id, const char* how) {
        if (++count > mostNamed) return;
        const field::FieldContainer* container = session_.find(id);
        named += fmt::format("{}{}:{}{} {}", named.empty() ? "" : ", ", id.space(), id.counter(),
                             container != nullptr ? " (" + container->type().name + ")" : "", how);
    };
    auto our = ours.begin();
    for (const auto& their : theirs.list) {
        const field::Id id{their.id};
        for (; our != ours.end() && our->id < id; ++our) differs(our->id, "is missing");
        if (our != ours.end() && our->id == id) {
            if (our->digest != their.digest) differs(id, "differs");
            ++our;
        } else {
            differs(id, "should not be there");
        }
    }
    if (theirs.list.size() < maxDigests)
        for (; our != ours.end(); ++our) differs(our->id, "is missing");
    if (count == 0) return {};
    return fmt::format("{} of {} containers are not as they should be: {}{}", count, ours.size(),
                       named, count > mostNamed ? ", ..." : "");
}

}  // namespace gnomon::net
