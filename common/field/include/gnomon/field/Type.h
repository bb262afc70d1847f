#pragma once

#include <gnomon/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::field {

class FieldContainer;

/// Bit i stands for the i-th field of the container's table.
using Mask = std::uint32_t;
/// FNV-1a of the type's name: the same in every process.
using TypeId = std::uint32_t;

constexpr TypeId typeIdOf(std::string_view name) noexcept {
    TypeId hash = 2166136261U;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    return hash;
}

struct FieldInfo {
    std::string name = {};
    std::string layout = {};  ///< see FieldTraits
    bool multi = false;
    friend bool operator==(const FieldInfo&, const FieldInfo&) = default;
};

/// What is known of a container type at run time.
struct TypeInfo {
    std::string name = {};
    TypeId id = 0;
    std::vector<FieldInfo> fields = {};
    bool replicated = true;  ///< false: never leaves the aspect it was made in
    bool opaque = false;     ///< true: known from another process's schema only
    std::unique_ptr<FieldContainer> (*make)(const TypeInfo&) = nullptr;

    Mask allFields() const noexcept {
        return fields.size() >= 32 ? ~Mask{0} : (Mask{1} << fields.size()) - 1;
    }
};

/// The container types one process knows. Shared by its aspects; the addresses of entries hold.
class TypeRegistry {
public:
    /// Adds a type of the application's own, described by its field table.
    template <class T>
    const TypeInfo& add() {
        return insert(T::describe());
    }
    const TypeInfo* find(TypeId id) const noexcept;
    template <class T>
    const TypeInfo& of() const {
        const TypeInfo* info = find(typeIdOf(T::typeName));
        GNOMON_EXPECTS(info != nullptr && !info->opaque, "the type was not added to the registry");
        return *info;
    }

    /// All replicated types, for Hello. Format: u32 count, then per type: string name, u32 fields,
    /// then per field: string name, string layout, u8 multi. Sorted by name.
    std::vector<std::byte> schema() const;
    /// Takes in the other side's schema. A type that both know must have the same fields in the
    /// same order; unknown types become opaque ones, whose containers are kept, digested and
    /// forwarded without being understood. @p who names the other side in the error.
    Result<void> agree(std::span<const std::byte> schema, std::string_view who);

private:
    const TypeInfo& insert(TypeInfo info);
    std::unordered_map<TypeId, std::unique_ptr<TypeInfo>> types_;
};

}  // namespace gnomon::field
