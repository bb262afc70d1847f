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

tl::unexpected<Error> refused(const Reader& from, const std::string& why) {
    return fail(Errc::protocol, "change list, byte " + std::to_string(from.at()) + ": " + why);
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
    containers_.emplace(id, std::move(container));
    stale(made);
    return made;
}

const FieldContainer& Aspect::create(const TypeInfo& type) {
    GNOMON_EXPECTS(nextCounter_ < Id::counterMask, "an aspect ran out of ids");
    FieldContainer& made = insert(type, Id::make(space_, nextCounter_++));
    if (recorded(made)) {
        made.uncommitted_ = true;
        created_.push_back(made.id_);
    }
    return made;
}

const FieldContainer* Aspect::find(Id id) const noexcept {
    const auto found = containers_.find(id);
    return found == containers_.end() ? nullptr : found->second.get();
}

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
    if (container.pending_ == 0 && !container.uncommitted_) changed_.push_back(container.id_);
    container.pending_ |= mask;
}

Result<void> Aspect::countUses() {
    if (log_.empty()) return {};
    Id missing;
    for (const Id id : log_.addedRefs) {
        const auto found = containers_.find(id);
        if (found == containers_.end())
            missing = id;
        else
            ++found->second->references_;
    }
    for (const Id id : log_.droppedRefs) {
        const auto found = containers_.find(id);
        if (found != containers_.end()) --found->second->references_;
    }
    for (const Payload& payload : log_.addedPayloads) payloads_.use(payload);
    for (const Payload& payload : log_.droppedPayloads)
        if (payloads_.drop(payload.hash())) unusedPayloads_.push_back(payload.hash());
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
    drop(gone, nullptr);
    erase(gone);
    return {};
}

Result<void> Aspect::destroyTree(const FieldContainer& container) {
    beginEdit(container);
    if (container.references_ > 0) return destroy(container);
    std::vector<Id> open{container.id_};
    while (!open.empty()) {
        const auto found = containers_.find(open.back());
        open.pop_back();
        if (found == containers_.end() || found->second->references_ > 0 ||
            found->first.space() != space_)
            continue;
        FieldContainer& gone = *found->second;
        drop(gone, &open);
        erase(gone);
    }
    return {};
}

void Aspect::drop(FieldContainer& container, std::vector<Id>* orphans) {
    container.changing(container.type_->allFields());
    container.dropUses(log_);
    if (orphans != nullptr)
        orphans->insert(orphans->end(), log_.droppedRefs.begin(), log_.droppedRefs.end());
    const auto counted = countUses();
    GNOMON_EXPECTS(counted.has_value(), "dropping references cannot fail");
    container.dropped_ = true;
}

void Aspect::erase(FieldContainer& container) {
    digest_ -= container.digest_;
    const Id id = container.id_;
    if (recorded(container) && id.space() == space_ && !container.uncommitted_)
        destroyed_.push_back(id);
    containers_.erase(id);
}

ChangeList Aspect::commit() {
    const auto exists = [&](Id id) { return containers_.contains(id); };
    std::erase_if(created_, [&](Id id) { return !exists(id); });
    std::erase_if(changed_, [&](Id id) { return !exists(id); });
    ChangeList list;
    if (created_.empty() && changed_.empty() && destroyed_.empty()) return list;

    writer_.clear();
    writer_.scalar(ChangeList::version);
    writer_.scalar(static_cast<std::uint32_t>(created_.size()));
    writer_.scalar(static_cast<std::uint32_t>(created_.size() + changed_.size()));
    writer_.scalar(static_cast<std::uint32_t>(destroyed_.size()));
    for (const Id id : created_) {
        writer_.scalar(containers_.find(id)->second->type_->id);
        writer_.id(id);
    }
    const auto writeChange = [&](Id id, bool created) {
        FieldContainer& container = *containers_.find(id)->second;
        const Mask mask = created ? container.type_->allFields() : container.pending_;
        writer_.id(id);
        writer_.scalar(mask);
        container.write(writer_, mask, created);
        container.clearRanges();
        container.pending_ = 0;
        container.uncommitted_ = false;
    };
    for (const Id id : created_) writeChange(id, true);
    for (const Id id : changed_) writeChange(id, false);
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
    for (const auto& [id, container] : containers_)
        if (recorded(*container)) sorted.push_back(container.get());
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

Result<void> Aspect::apply(const ChangeList& list, Applied* applied) {
    return applyBlocks(list, applied, false);
}

Result<std::uint64_t> Aspect::adopt(const ChangeList& list) {
    const std::uint64_t offset = Id::make(space_, nextCounter_ - 1).value;
    auto done = applyBlocks(list, nullptr, true);
    if (!done) return tl::unexpected{std::move(done).error()};
    return offset;
}

Result<void> Aspect::applyBlocks(const ChangeList& list, Applied* applied, bool own) {
    payloads_.arrive(list.payloads);
    // With an offset the reader refuses ids so large that they would leave those not yet given out.
    Reader from{list.bytes, &payloads_, own ? Id::make(space_, nextCounter_ - 1).value : 0};
    Result<void> done;
    while (done && from.remaining() > 0) done = applyBlock(from, applied, own);
    payloads_.endArrival();
    return done;
}

Result<void> Aspect::applyCreations(Reader& from, std::uint32_t count, Applied* applied, bool own) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto typeId = from.scalar<TypeId>();
        const Id id = from.id();
        if (from.failed()) return refused(from, from.why());
        const TypeInfo* type = types_.find(typeId);
        if (type == nullptr)
            return refused(from, nameOf(id) + " is of unknown type " + std::to_string(typeId));
        if (!id) return refused(from, "a container with id 0");
        if (!own && space_ != 0 && id.space() == space_)
            return refused(from, nameOf(id) + " is not the sender's to create");
        if (containers_.contains(id)) return refused(from, nameOf(id) + " is created twice");
        FieldContainer& made = insert(*type, id);
        if (own) nextCounter_ = std::max(nextCounter_, id.counter() + 1);
        if (own && recorded(made)) {
            made.uncommitted_ = true;
            created_.push_back(id);
        }
        if (applied != nullptr) applied->created.push_back(id);
    }
    return {};
}

Result<void> Aspect::applyChanges(Reader& from, std::uint32_t count,
                                  std::vector<FieldContainer*>& touched, Applied* applied,
                                  bool own) {
    touched.reserve(std::min<std::size_t>(count, from.remaining() / 12));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Id id = from.id();
        const auto mask = from.scalar<Mask>();
        if (from.failed()) return refused(from, from.why());
        const auto found = containers_.find(id);
        if (found == containers_.end()) return refused(from, nameOf(id) + " does not exist");
        FieldContainer& container = *found->second;
        const auto where = [&] { return nameOf(id) + " (" + container.type_->name + "): "; };
        if (!own && space_ != 0 && id.space() == space_)
            return refused(from, where() + "not the sender's to change");
        if ((mask & ~container.type_->allFields()) != 0)
            return refused(from,
                           where() + "mask " + std::to_string(mask) + " names fields it has not");
        container.changing(mask);
        container.read(from, mask);
        // Settled also where it failed, so that the counts stay true to the fields.
        settle(container);
        const auto counted = countUses();
        if (from.failed()) return refused(from, where() + from.why());
        if (!counted) return refused(from, where() + counted.error().what);
        container.clearRanges();
        container.changed(mask);
        touched.push_back(&container);
        if (applied != nullptr) applied->changed.push_back({.id = id, .mask = mask});
    }
    return {};
}

Result<void> Aspect::applyReleases(Reader& from, std::uint32_t count,
                                   std::vector<FieldContainer*>& going, bool own) {
    going.reserve(std::min<std::size_t>(count, from.remaining() / 8));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Id id = from.id();
        if (from.failed()) return refused(from, from.why());
        const auto found = containers_.find(id);
        if (found == containers_.end() || found->second->dropped_)
            return refused(from, nameOf(id) + " does not exist");
        if (!own && space_ != 0 && id.space() == space_)
            return refused(from, nameOf(id) + " is not the sender's to release");
        drop(*found->second, nullptr);
        going.push_back(found->second.get());
    }
    return {};
}

Result<void> Aspect::applyBlock(Reader& from, Applied* applied, bool own) {
    const auto version = from.scalar<std::uint8_t>();
    if (version != ChangeList::version)
        return refused(from, "version " + std::to_string(version) + ", expected " +
                                 std::to_string(ChangeList::version));
    const auto creations = from.scalar<std::uint32_t>();
    const auto changes = from.scalar<std::uint32_t>();
    const auto releases = from.scalar<std::uint32_t>();
    if (from.failed()) return refused(from, from.why());
    std::vector<FieldContainer*> touched;
    std::vector<FieldContainer*> going;
    if (auto done = applyCreations(from, creations, applied, own); !done) return done;
    if (auto done = applyChanges(from, changes, touched, applied, own); !done) return done;
    // Those released together may refer to each other in any way, so all let go before any goes.
    if (auto done = applyReleases(from, releases, going, own); !done) return done;
    for (const FieldContainer* container : touched) {
        if (container->dropped_) continue;
        auto sound = container->validate();
        if (!sound) return refused(from, sound.error().what);
    }
    for (FieldContainer* container : going) {
        const Id id = container->id_;
        if (container->references_ > 0)
            return refused(from, nameOf(id) + " is released but still referred to");
        erase(*container);
        if (applied != nullptr) applied->destroyed.push_back(id);
    }
    return {};
}

void Aspect::stale(FieldContainer& container) {
    if (container.digestStale_ || !container.type_->replicated) return;
    container.digestStale_ = true;
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
    for (const Id id : staleDigests_) {
        const auto found = containers_.find(id);
        if (found == containers_.end()) continue;
        FieldContainer& container = *found->second;
        const auto now = computeDigest(container);
        digest_ += now - container.digest_;
        container.digest_ = now;
        container.digestStale_ = false;
    }
    staleDigests_.clear();
    return digest_;
}

std::uint64_t Aspect::digest(Id id) {
    const FieldContainer* found = find(id);
    return found == nullptr || !found->type().replicated ? 0 : computeDigest(*found);
}

}  // namespace gnomon::field
