#include <gnomon/field/Aspect.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>

namespace gnomon::field {
namespace {

std::string nameOf(const FieldContainer& c) {
    return c.type().name + " " + std::to_string(c.id().space()) + ":" +
           std::to_string(c.id().counter());
}

std::string nameOf(Id id) {
    return "container " + std::to_string(id.space()) + ":" + std::to_string(id.counter());
}

}  // namespace

Payload PayloadStore::find(const Hash128& hash) const {
    if (const auto found = used_.find(hash); found != used_.end()) return found->second.payload;
    const auto found = arrived_.find(hash);
    return found == arrived_.end() ? Payload{} : found->second;
}

void PayloadStore::arrive(const std::vector<Payload>& payloads) {
    for (const Payload& payload : payloads)
        if (payload) arrived_.try_emplace(payload.hash(), payload);
}

void PayloadStore::endArrival() { arrived_.clear(); }

void PayloadStore::use(const Payload& payload) {
    Used& entry = used_[payload.hash()];
    if (entry.fields++ == 0) entry.payload = payload;
}

bool PayloadStore::drop(const Hash128& hash) {
    const auto found = used_.find(hash);
    if (found == used_.end() || --found->second.fields > 0) return false;
    used_.erase(found);
    return true;
}

Aspect::Aspect(const TypeRegistry& types, std::uint16_t space, bool recordLocal)
    : types_{types}, space_{space}, recordLocal_{recordLocal} {}

Aspect::~Aspect() = default;

FieldContainer& Aspect::insert(const TypeInfo& type, Id id) {
    auto container = type.make(type);
    container->id_ = id;
    container->type_ = &type;
    container->aspect_ = this;
    FieldContainer& made = *container;
    containers_.insert(id, std::move(container));
    stale(made);
    return made;
}

const FieldContainer& Aspect::create(const TypeInfo& type) {
    GNOMON_EXPECTS(nextCounter_ < Id::counterMask, "an aspect ran out of ids");
    FieldContainer& made = insert(type, Id::make(space_, nextCounter_++));
    if (recorded(made)) listCreated(made);
    return made;
}

void Aspect::listCreated(FieldContainer& container) {
    container.uncommitted_ = true;
    container.slot_ = static_cast<std::uint32_t>(created_.size());
    created_.push_back(&container);
}

const FieldContainer* Aspect::find(Id id) const noexcept { return containers_.find(id); }

void Aspect::beginEdit(const FieldContainer& container) const {
    if (container.id_.space() != space_)
        throw Failure{Errc::edit, nameOf(container) + " is written by the aspect of space " +
                                      std::to_string(container.id_.space()) + ", not by that of " +
                                      std::to_string(space_)};
}

Mask Aspect::settle(FieldContainer& container) {
    const Mask mask = container.takeTouched(log_);
    if (mask != 0) stale(container);
    return mask;
}

void Aspect::finishEdit(FieldContainer& container) {
    const Mask mask = settle(container);
    if (mask == 0) return;
    const auto counted = countUses();
    GNOMON_EXPECTS(counted.has_value(), "a field refers to a container that does not exist");
    if (!recorded(container)) return;
    if (container.pending_ == 0 && !container.uncommitted_) {
        container.slot_ = static_cast<std::uint32_t>(changed_.size());
        changed_.push_back(&container);
    }
    container.pending_ |= mask;
}

Result<void> Aspect::countUses() {
    if (log_.empty()) return {};
    Id missing;
    for (const Id id : log_.addedRefs) {
        if (FieldContainer* found = containers_.find(id))
            ++found->references_;
        else
            missing = id;
    }
    for (const Id id : log_.droppedRefs) {
        if (FieldContainer* found = containers_.find(id)) --found->references_;
    }
    for (const Payload& payload : log_.addedPayloads) payloads_.use(payload);
    for (const Payload& payload : log_.droppedPayloads)
        if (payloads_.drop(payload.hash()) && followsPayloads_)
            unusedPayloads_.push_back(payload.hash());
    log_.clear();
    if (missing)
        return fail(Errc::protocol,
                    "a field refers to " + nameOf(missing) + ", which does not exist");
    return {};
}

std::vector<Hash128> Aspect::takeUnusedPayloads() {
    std::erase_if(unusedPayloads_, [&](const Hash128& h) { return payloads_.used(h); });
    return std::exchange(unusedPayloads_, {});
}

Result<void> Aspect::destroy(const FieldContainer& container) {
    beginEdit(container);
    if (container.references_ > 0)
        return fail(Errc::edit, nameOf(container) + " cannot be destroyed: " +
                                    std::to_string(container.references_) +
                                    " field(s) still refer to it");
    auto& gone = const_cast<FieldContainer&>(container);
    orThrow(drop(gone, nullptr));
    erase(gone);
    return {};
}

Result<void> Aspect::destroyTree(const FieldContainer& container) {
    beginEdit(container);
    if (container.references_ > 0) return destroy(container);
    std::vector<Id> open{container.id_};
    while (!open.empty()) {
        FieldContainer* gone = containers_.find(open.back());
        open.pop_back();
        if (gone == nullptr || gone->references_ > 0 || gone->id_.space() != space_) continue;
        orThrow(drop(*gone, &open));
        erase(*gone);
    }
    return {};
}

Result<void> Aspect::drop(FieldContainer& container, std::vector<Id>* orphans) {
    if (auto sound = container.dropping(); !sound) return sound;
    container.dropUses(log_);
    if (orphans != nullptr)
        orphans->insert(orphans->end(), log_.droppedRefs.begin(), log_.droppedRefs.end());
    const auto counted = countUses();
    GNOMON_EXPECTS(counted.has_value(), "dropping references cannot fail");
    container.dropped_ = true;
    return {};
}

void Aspect::erase(FieldContainer& container) {
    digest_ -= container.digest_;
    const Id id = container.id_;
    if (container.uncommitted_)
        created_[container.slot_] = nullptr;
    else if (container.pending_ != 0)
        changed_[container.slot_] = nullptr;
    if (recorded(container) && id.space() == space_ && !container.uncommitted_)
        destroyed_.push_back(id);
    containers_.erase(id);
}

ChangeList Aspect::commit() {
    std::erase(created_, nullptr);
    std::erase(changed_, nullptr);
    ChangeList list;
    if (created_.empty() && changed_.empty() && destroyed_.empty()) return list;

    writer_.clear();
    writer_.scalar(ChangeList::version);
    writer_.scalar(static_cast<std::uint32_t>(created_.size()));
    writer_.scalar(static_cast<std::uint32_t>(created_.size() + changed_.size()));
    writer_.scalar(static_cast<std::uint32_t>(destroyed_.size()));
    for (const FieldContainer* container : created_) {
        writer_.scalar(container->type_->id);
        writer_.id(container->id_);
    }
    const auto writeChange = [&](FieldContainer& container, bool created) {
        const Mask mask = created ? container.type_->allFields() : container.pending_;
        writer_.id(container.id_);
        writer_.scalar(mask);
        container.write(writer_, mask, created);
        container.clearRanges();
        container.pending_ = 0;
        container.uncommitted_ = false;
    };
    for (FieldContainer* container : created_) writeChange(*container, true);
    for (FieldContainer* container : changed_) writeChange(*container, false);
    for (const Id id : destroyed_) writer_.id(id);
    created_.clear();
    changed_.clear();
    destroyed_.clear();

    const auto written = writer_.written();
    list.bytes.assign(written.begin(), written.end());
    list.payloads = writer_.takePayloads();
    return list;
}

ChangeList Aspect::snapshot() const {
    std::vector<const FieldContainer*> sorted;
    containers_.forEach([&](const FieldContainer& container) {
        if (recorded(container)) sorted.push_back(&container);
    });
    std::sort(sorted.begin(), sorted.end(),
              [](const auto* a, const auto* b) { return a->id() < b->id(); });
    Writer to;
    to.scalar(ChangeList::version);
    to.scalar(static_cast<std::uint32_t>(sorted.size()));
    to.scalar(static_cast<std::uint32_t>(sorted.size()));
    to.scalar(std::uint32_t{0});
    for (const auto* container : sorted) {
        to.scalar(container->type().id);
        to.id(container->id());
    }
    for (const auto* container : sorted) {
        const Mask mask = container->type().allFields();
        to.id(container->id());
        to.scalar(mask);
        container->write(to, mask, true);
    }
    return {.bytes = to.take(), .payloads = to.takePayloads()};
}

void Aspect::stale(FieldContainer& container) {
    if (container.digestStale_ || !container.type_->replicated) return;
    container.digestStale_ = true;
    // Those that are gone again, where nobody asks for digests.
    if (staleDigests_.size() > 2 * containers_.size() + 64)
        std::erase_if(staleDigests_, [&](Id id) { return containers_.find(id) == nullptr; });
    staleDigests_.push_back(container.id_);
}

std::uint64_t Aspect::computeDigest(const FieldContainer& container) {
    digestWriter_.clear();
    digestWriter_.id(container.id_);
    digestWriter_.scalar(container.type_->id);
    container.write(digestWriter_, container.type_->allFields(), true);
    const auto bytes = digestWriter_.written();
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t Aspect::digest() {
    ContainerTable::Cursor containers{containers_};
    for (const Id id : staleDigests_) {
        FieldContainer* container = containers.find(id);
        if (container == nullptr) continue;
        const auto now = computeDigest(*container);
        digest_ += now - container->digest_;
        container->digest_ = now;
        container->digestStale_ = false;
    }
    staleDigests_.clear();
    return digest_;
}

std::vector<ContainerDigest> Aspect::digests() {
    std::vector<ContainerDigest> all;
    containers_.forEach([&](const FieldContainer& container) {
        if (container.type().replicated)
            all.push_back({.id = container.id(), .digest = computeDigest(container)});
    });
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return all;
}

}  // namespace gnomon::field
