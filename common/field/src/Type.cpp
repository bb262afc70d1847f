#include <gnomon/field/FieldContainer.h>
#include <gnomon/field/Type.h>

#include <algorithm>
#include <unordered_set>

#include "Opaque.h"

namespace gnomon::field {
namespace {

/// Letters a layout may consist of; s, r and p stand alone.
bool layoutIsKnown(std::string_view layout) {
    if (layout == "s" || layout == "r" || layout == "p") return true;
    return !layout.empty() && layout.size() <= 64 &&
           layout.find_first_not_of("bBiuIUfd") == std::string_view::npos;
}

std::string text(const FieldInfo& field) {
    return "\"" + field.name + "\" (" + field.layout + (field.multi ? ", multi)" : ")");
}

/// Empty where both agree, else what differs.
std::string disagreement(const TypeInfo& ours, const TypeInfo& theirs) {
    const auto count = std::min(ours.fields.size(), theirs.fields.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (ours.fields[i] == theirs.fields[i]) continue;
        return "field " + std::to_string(i) + " is " + text(theirs.fields[i]) + ", expected " +
               text(ours.fields[i]);
    }
    if (ours.fields.size() == theirs.fields.size()) return {};
    const bool more = theirs.fields.size() > count;
    return (more ? "has a field " + text(theirs.fields[count]) + " that is not expected"
                 : "lacks the field " + text(ours.fields[count]));
}

}  // namespace

const TypeInfo* TypeRegistry::find(TypeId id) const noexcept {
    const auto found = types_.find(id);
    return found == types_.end() ? nullptr : found->second.get();
}

const TypeInfo& TypeRegistry::insert(TypeInfo info) {
    auto& slot = types_[info.id];
    GNOMON_EXPECTS(!slot || slot->name == info.name, "two type names with one hash");
    for (const auto& field : info.fields)
        GNOMON_EXPECTS(layoutIsKnown(field.layout), "a field's layout has unknown letters");
    if (!slot) slot = std::make_unique<TypeInfo>(std::move(info));
    return *slot;
}

std::vector<std::byte> TypeRegistry::schema() const {
    std::vector<const TypeInfo*> sorted;
    for (const auto& [id, type] : types_)
        if (type->replicated) sorted.push_back(type.get());
    std::sort(sorted.begin(), sorted.end(),
              [](const TypeInfo* a, const TypeInfo* b) { return a->name < b->name; });
    Writer to;
    to.scalar(static_cast<std::uint32_t>(sorted.size()));
    for (const TypeInfo* type : sorted) {
        to.string(type->name);
        to.scalar(static_cast<std::uint32_t>(type->fields.size()));
        for (const auto& field : type->fields) {
            to.string(field.name);
            to.string(field.layout);
            to.scalar(static_cast<std::uint8_t>(field.multi));
        }
    }
    return to.take();
}

Result<void> TypeRegistry::agree(std::span<const std::byte> schema, std::string_view who) {
    const auto refuse = [&](const std::string& why) {
        return fail(Errc::schema, "schema of " + std::string{who} + ": " + why);
    };
    Reader from{schema};
    std::vector<TypeInfo> theirs;
    std::unordered_set<TypeId> ids;
    const auto count = from.scalar<std::uint32_t>();
    for (std::uint32_t i = 0; i < count && !from.failed(); ++i) {
        TypeInfo type{.name = from.string(), .opaque = true, .make = makeOpaque};
        type.id = typeIdOf(type.name);
        const auto fields = from.scalar<std::uint32_t>();
        if (fields > 32) return refuse("type \"" + type.name + "\" has more than 32 fields");
        for (std::uint32_t k = 0; k < fields && !from.failed(); ++k) {
            FieldInfo field{.name = from.string(), .layout = from.string()};
            field.multi = from.scalar<std::uint8_t>() != 0;
            if (!from.failed() && !layoutIsKnown(field.layout))
                return refuse("type \"" + type.name + "\", field \"" + field.name +
                              "\": unknown layout \"" + field.layout + "\"");
            type.fields.push_back(std::move(field));
        }
        if (!from.failed() && !ids.insert(type.id).second)
            return refuse("type \"" + type.name + "\" is named twice, or has another one's id");
        theirs.push_back(std::move(type));
    }
    if (from.failed() || from.remaining() > 0)
        return refuse("malformed at byte " + std::to_string(from.at()) + " of " +
                      std::to_string(schema.size()));
    for (const TypeInfo& type : theirs) {
        const TypeInfo* ours = find(type.id);
        if (ours == nullptr) continue;
        if (ours->name != type.name)
            return refuse("type \"" + type.name + "\" has the id of \"" + ours->name + "\"");
        if (const auto why = disagreement(*ours, type); !why.empty())
            return refuse("type \"" + type.name + "\": " + why);
    }
    for (TypeInfo& type : theirs)
        if (find(type.id) == nullptr) insert(std::move(type));
    return {};
}

}  // namespace gnomon::field
