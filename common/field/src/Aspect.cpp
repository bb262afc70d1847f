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

}  // namespace

Payload PayloadStore::find(const Hash128& hash) const {
    const auto found = known_.find(hash);
    return found == known_.end() ? Payload{} : Payload{found->second.lock()};
}

void PayloadStore::know(const Payload& payload) {
    if (payload) known_[payload.hash()] = payload.data_;
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
    const auto counted = count(log_);
    log_ = {};
    GNOMON_EXPECTS(counted.has_value(), "a field refers to a container that does not exist");
    if (!recorded(container)) return;
    if (container.pending_ == 0 && !container.uncommitted_) changed_.push_back(container.id_);
    container.pending_ |= mask;
}

Result<void> Aspect::count(const UseLog& log) {
    for (const Id id : log.addedRefs) {
        const auto found = containers_.find(id);
        if (found == containers_.end())
            return fail(Errc::protocol, "a field refers to container " +
                                            std::to_string(id.space()) + ":" +
                                            std::to_string(id.counter()) +
                                            ", which does not exist");
        ++found->second->references_;
    }
    for (const Id id : log.droppedRefs) {
        const auto found = containers_.find(id);
        if (found != containers_.end()) --found->second->references_;
    }
    for (const Payload& payload : log.addedPayloads) {
        payloads_.know(payload);
        ++payloadUses_[payload.hash()];
    }
    for (const Payload& payload : log.droppedPayloads) {
        const auto found = payloadUses_.find(payload.hash());
        if (found == payloadUses_.end() || --found->second > 0) continue;
        payloadUses_.erase(found);
        payloads_.forget(payload.hash());
        unusedPayloads_.push_back(payload.hash());
    }
    return {};
}

std::vector<Hash128> Aspect::takeUnusedPayloads() {
    std::erase_if(unusedPayloads_, [&](const Hash128& h) { return payloadUses_.contains(h); });
    return std::exchange(unusedPayloads_, {});
}

Result<void> Aspect::destroy(const FieldContainer& container) {
    beginEdit(container);
    if (container.references_ > 0)
        return fail(Errc::edit, nameOf(container) + " cannot be destroyed: " +
                                    std::to_string(container.references_) +
                                    " field(s) still refer to it");
    remove(const_cast<FieldContainer&>(container), nullptr);
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
        remove(*found->second, &open);
    }
    return {};
}

void Aspect::remove(FieldContainer& container, std::vector<Id>* orphans) {
    container.changing(container.type_->allFields());
    UseLog log;
    container.dropUses(log);
    if (orphans != nullptr)
        orphans->insert(orphans->end(), log.droppedRefs.begin(), log.droppedRefs.end());
    const auto counted = count(log);
    GNOMON_EXPECTS(counted.has_value(), "dropping references cannot fail");
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
    for (const Payload& payload : list.payloads) payloads_.know(payload);
    Reader from{list.bytes, &payloads_};
    while (from.remaining() > 0) {
        auto done = applyBlock(from, applied, false);
        if (!done) return done;
    }
    return {};
}

Result<std::uint64_t> Aspect::adopt(const ChangeList& list) {
    for (const Payload& payload : list.payloads) payloads_.know(payload);
    const std::uint64_t offset = Id::make(space_, nextCounter_ - 1).value;
    Reader from{list.bytes, &payloads_, offset};
    while (from.remaining() > 0) {
        auto done = applyBlock(from, nullptr, true);
        if (!done) return tl::unexpected{std::move(done).error()};
    }
    return offset;
}

Result<void> Aspect::applyBlock(Reader& from, Applied* applied, bool own) {
    const auto refuse = [&](const std::string& why) {
        return fail(Errc::protocol,
                    "change list, byte " + std::to_string(from.at()) + ": " + why);
    };
    const auto describe = [](Id id) {
        return "container " + std::to_string(id.space()) + ":" + std::to_string(id.counter());
    };
    const auto version = from.scalar<std::uint8_t>();
    if (!from.failed() && version != ChangeList::version)
        return refuse("version " + std::to_string(version) + ", expected " +
                      std::to_string(ChangeList::version));
    const auto creations = from.scalar<std::uint32_t>();
    const auto changes = from.scalar<std::uint32_t>();
    const auto releases = from.scalar<std::uint32_t>();

    for (std::uint32_t i = 0; i < creations; ++i) {
        const auto typeId = from.scalar<TypeId>();
        const Id id = from.id();
        if (from.failed()) return refuse(from.why());
        const TypeInfo* type = types_.find(typeId);
        if (type == nullptr)
            return refuse(describe(id) + " is of unknown type " + std::to_string(typeId));
        if (!id || (own && (id.space() != space_ || id.counter() < nextCounter_)))
            return refuse("id out of range");
        if (!own && space_ != 0 && id.space() == space_)
            return refuse(describe(id) + " is not the sender's to create");
        if (containers_.contains(id)) return refuse(describe(id) + " is created twice");
        FieldContainer& made = insert(*type, id);
        if (own && recorded(made)) {
            made.uncommitted_ = true;
            created_.push_back(id);
        }
        if (applied != nullptr) applied->created.push_back(id);
    }
    if (own && creations > 0)
        for (const auto& [id, container] : containers_)
            if (id.space() == space_) nextCounter_ = std::max(nextCounter_, id.counter() + 1);

    std::vector<FieldContainer*> touched;
    touched.reserve(std::min<std::size_t>(changes, from.remaining() / 12));
    for (std::uint32_t i = 0; i < changes; ++i) {
        const Id id = from.id();
        const auto mask = from.scalar<Mask>();
        if (from.failed()) return refuse(from.why());
        const auto found = containers_.find(id);
        if (found == containers_.end()) return refuse(describe(id) + " does not exist");
        FieldContainer& container = *found->second;
        const auto where = [&] { return describe(id) + " (" + container.type_->name + "): "; };
        if ((mask & ~container.type_->allFields()) != 0)
            return refuse(where() + "mask " + std::to_string(mask) + " names fields it has not");
        container.changing(mask);
        container.read(from, mask);
        if (from.failed()) return refuse(where() + from.why());
        settle(container);
        if (!log_.empty()) {
            const auto counted = count(log_);
            log_ = {};
            if (!counted) return refuse(where() + counted.error().what);
        }
        container.clearRanges();
        container.changed(mask);
        touched.push_back(&container);
        if (applied != nullptr) applied->changed.push_back({.id = id, .mask = mask});
    }
    for (const FieldContainer* container : touched) {
        auto sound = container->validate();
        if (!sound) return refuse(sound.error().what);
    }
    for (std::uint32_t i = 0; i < releases; ++i) {
        const Id id = from.id();
        if (from.failed()) return refuse(from.why());
        const auto found = containers_.find(id);
        if (found == containers_.end()) return refuse(describe(id) + " does not exist");
        if (found->second->references_ > 0)
            return refuse(describe(id) + " is released but still referred to");
        remove(*found->second, nullptr);
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
