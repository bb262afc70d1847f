// What change lists do to an aspect. Nothing of what they say is believed.
#include <gnomon/field/Aspect.h>

#include <algorithm>

namespace gnomon::field {
namespace {

std::string numberOf(Id id) {
    return "container " + std::to_string(id.space()) + ":" + std::to_string(id.counter());
}

tl::unexpected<Error> refused(const Reader& from, const std::string& why) {
    return fail(Errc::protocol, "change list, byte " + std::to_string(from.at()) + ": " + why);
}

}  // namespace

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
            return refused(from, numberOf(id) + " is of unknown type " + std::to_string(typeId));
        if (!id) return refused(from, "a container with id 0");
        if (!own && space_ != 0 && id.space() == space_)
            return refused(from, numberOf(id) + " is not the sender's to create");
        if (containers_.find(id) != nullptr)
            return refused(from, numberOf(id) + " is created twice");
        FieldContainer& made = insert(*type, id);
        if (own) nextCounter_ = std::max(nextCounter_, id.counter() + 1);
        if (own && recorded(made)) listCreated(made);
        if (applied != nullptr) applied->created.push_back(id);
    }
    return {};
}

Result<void> Aspect::applyChanges(Reader& from, std::uint32_t count,
                                  std::vector<FieldContainer*>& touched, Applied* applied,
                                  bool own) {
    touched.reserve(std::min<std::size_t>(count, from.remaining() / 12));
    ContainerTable::Cursor containers{containers_};
    for (std::uint32_t i = 0; i < count; ++i) {
        const Id id = from.id();
        const auto mask = from.scalar<Mask>();
        if (from.failed()) return refused(from, from.why());
        FieldContainer* const found = containers.find(id);
        if (found == nullptr) return refused(from, numberOf(id) + " does not exist");
        FieldContainer& container = *found;
        const auto where = [&] { return numberOf(id) + " (" + container.type_->name + "): "; };
        if (!own && space_ != 0 && id.space() == space_)
            return refused(from, where() + "not the sender's to change");
        if ((mask & ~container.type_->allFields()) != 0)
            return refused(from,
                           where() + "mask " + std::to_string(mask) + " names fields it has not");
        container.read(from, mask);
        const auto sound = from.failed() ? Result<void>{} : container.changed(mask);
        // Settled also where it failed, so that the counts stay true to the fields.
        settle(container);
        const auto counted = countUses();
        if (from.failed()) return refused(from, where() + from.why());
        if (!counted) return refused(from, where() + counted.error().what);
        if (!sound) return refused(from, sound.error().what);
        container.clearRanges();
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
        FieldContainer* const found = containers_.find(id);
        if (found == nullptr || found->dropped_)
            return refused(from, numberOf(id) + " does not exist");
        if (!own && space_ != 0 && id.space() == space_)
            return refused(from, numberOf(id) + " is not the sender's to release");
        if (auto dropped = drop(*found, nullptr); !dropped)
            return refused(from, dropped.error().what);
        going.push_back(found);
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
    for (FieldContainer* container : touched) {
        if (container->dropped_) continue;
        auto sound = container->validate();
        if (!sound) return refused(from, sound.error().what);
    }
    for (FieldContainer* container : going) {
        const Id id = container->id_;
        if (container->references_ > 0)
            return refused(from, numberOf(id) + " is released but still referred to");
        erase(*container);
        if (applied != nullptr) applied->destroyed.push_back(id);
    }
    return {};
}

}  // namespace gnomon::field
