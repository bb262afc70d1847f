#pragma once

#include <gnomon/field/Field.h>
#include <gnomon/field/Type.h>

#include <memory>
#include <string>
#include <string_view>
#include <tuple>

namespace gnomon::field {

class Aspect;

/// Base of everything that is replicated. Lives in exactly one aspect, which owns it; everybody
/// else sees it const and writes through `edit(container)`.
class FieldContainer {
public:
    FieldContainer() = default;
    virtual ~FieldContainer() = default;
    FieldContainer(const FieldContainer&) = delete;
    FieldContainer& operator=(const FieldContainer&) = delete;

    Id id() const noexcept { return id_; }
    const TypeInfo& type() const noexcept { return *type_; }
    Aspect& aspect() const noexcept { return *aspect_; }
    /// How many fields refer to this container.
    std::uint32_t references() const noexcept { return references_; }

    /// Appends the fields in @p mask in table order; @p whole: multi fields entire, else the range
    /// that changed since the last commit.
    virtual void write(Writer& to, Mask mask, bool whole) const = 0;

protected:
    friend class Aspect;
    template <class T>
    friend class Edit;

    virtual void read(Reader& from, Mask mask) = 0;
    /// Fields written since the last call; logs what they referred to before and now.
    virtual Mask takeTouched(UseLog& log) = 0;
    virtual void clearRanges() noexcept = 0;
    /// Logs every reference and payload as dropped.
    virtual void dropUses(UseLog& log) = 0;
    /// Called after a change list overwrote these fields; multi fields tell which references came
    /// and went. Costs no more than these: a list may change a container often.
    virtual Result<void> changed(Mask /*mask*/) { return {}; }
    /// Called before its references are dropped, for it is about to be destroyed.
    virtual Result<void> dropping() { return {}; }
    /// Called after a block of a change list was applied: is what it made of this container sound?
    /// Costs no more than what changed since the last call.
    virtual Result<void> validate() { return {}; }

private:
    Id id_ = {};
    const TypeInfo* type_ = nullptr;
    Aspect* aspect_ = nullptr;
    std::uint64_t digest_ = 0;
    std::uint32_t references_ = 0;
    Mask pending_ = 0;          // changed since the last commit
    std::uint32_t slot_ = 0;    // where the aspect lists it as created or changed
    bool uncommitted_ = false;  // created since the last commit
    bool digestStale_ = false;
    bool dropped_ = false;  // about to be destroyed: its references no longer count
};

/// One line of a container's field table.
template <class C, class F>
struct FieldEntry {
    std::string_view name;
    F C::*member;
};

template <class C, class F>
constexpr FieldEntry<C, F> entry(std::string_view name, F C::*member) noexcept {
    return {name, member};
}

/// Derives codec, schema and bookkeeping from a field table, which Self lists once:
///
///     class Transform final : public Container<Transform, NodeCore> {
///     public:
///         static constexpr std::string_view typeName = "Transform";
///         Field<Affine> matrix;
///         static constexpr auto fields() { return std::tuple{entry("matrix", &Transform::matrix)};
///         }
///     };
///
/// `static constexpr bool replicated = false;` in Self keeps the type in its own process.
template <class Self, class Base = FieldContainer>
class Container : public Base {
public:
    static TypeInfo describe() {
        TypeInfo info{.name = std::string{Self::typeName}, .id = typeIdOf(Self::typeName)};
        forEach([&](auto, const auto& line) {
            using F = FieldOf<decltype(line)>;
            info.fields.push_back({.name = std::string{line.name},
                                   .layout = std::string{F::layout},
                                   .multi = F::multi});
        });
        if constexpr (requires { Self::replicated; }) info.replicated = Self::replicated;
        info.make = [](const TypeInfo&) -> std::unique_ptr<FieldContainer> {
            return std::make_unique<Self>();
        };
        return info;
    }

    void write(Writer& to, Mask mask, bool whole) const final {
        forEach([&](auto i, const auto& line) {
            if (mask >> i & 1U) (self().*line.member).write(to, whole);
        });
    }

protected:
    void read(Reader& from, Mask mask) final {
        forEach([&](auto i, const auto& line) {
            if (mask >> i & 1U) (self().*line.member).read(from);
        });
    }
    Mask takeTouched(UseLog& log) final {
        Mask mask = 0;
        forEach([&](auto i, const auto& line) {
            auto& field = self().*line.member;
            if (!field.takeTouched()) return;
            mask |= Mask{1} << i;
            field.flushUses(log);
        });
        return mask;
    }
    void clearRanges() noexcept final {
        forEach([&](auto, const auto& line) { (self().*line.member).clearRange(); });
    }
    void dropUses(UseLog& log) final {
        forEach([&](auto, const auto& line) {
            (self().*line.member).dropUses();
            (self().*line.member).flushUses(log);
        });
    }

private:
    template <class Line>
    using FieldOf = std::remove_cvref_t<decltype(std::declval<Self&>().*
                                                 std::declval<std::remove_cvref_t<Line>>().member)>;

    const Self& self() const noexcept { return static_cast<const Self&>(*this); }
    Self& self() noexcept { return static_cast<Self&>(*this); }

    template <class Fn>
    static constexpr void forEach(Fn&& fn) {
        static_assert(std::tuple_size_v<decltype(Self::fields())> <= 32);
        std::apply(
            [&](const auto&... lines) {
                unsigned i = 0;
                (fn(i++, lines), ...);
            },
            Self::fields());
    }
};

/// The mask bit of a field, from the table: `maskOf<Transform>("matrix")`.
template <class T>
constexpr Mask maskOf(std::string_view name) {
    Mask mask = 0;
    std::apply(
        [&](const auto&... lines) {
            unsigned i = 0;
            ((mask |= lines.name == name ? Mask{1} << i : Mask{0}, ++i), ...);
        },
        T::fields());
    return mask;
}

/// "Transform 12:7 { matrix = 1 0 ... }", from the table; payloads print as hash and size.
std::string print(const FieldContainer& container);
/// The same type and the same values in every field; ids do not count.
bool sameFields(const FieldContainer& a, const FieldContainer& b);

}  // namespace gnomon::field
