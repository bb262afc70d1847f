#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::field {

/// Names a container for ever: ids are never used again. The upper 16 bits say whose it is (the
/// *space*: the one aspect that may write it), the lower 48 bits count. 0 names nothing.
struct Id {
    std::uint64_t value = 0;

    static constexpr int counterBits = 48;
    static constexpr std::uint64_t counterMask = (std::uint64_t{1} << counterBits) - 1;

    static constexpr Id make(std::uint16_t space, std::uint64_t counter) noexcept {
        return {(std::uint64_t{space} << counterBits) | counter};
    }
    constexpr std::uint16_t space() const noexcept {
        return static_cast<std::uint16_t>(value >> counterBits);
    }
    constexpr std::uint64_t counter() const noexcept { return value & counterMask; }
    constexpr explicit operator bool() const noexcept { return value != 0; }
    friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

/// A field's reference to a container of type T (or derived from it): its id.
/// Resolved by `Aspect::get`, which returns nullptr where it does not exist or is of another type.
template <class T>
struct Ref {
    Id id = {};

    constexpr Ref() noexcept = default;
    constexpr explicit Ref(Id target) noexcept : id{target} {}
    /// From a container, so that `e->core = transform` works.
    template <std::derived_from<T> U>
    Ref(const U& container) noexcept : id{container.id()} {}
    template <std::derived_from<T> U>
    constexpr Ref(Ref<U> other) noexcept : id{other.id} {}

    constexpr explicit operator bool() const noexcept { return static_cast<bool>(id); }
    friend constexpr bool operator==(const Ref&, const Ref&) = default;
};

/// Names a container without holding it: it may be destroyed, and the name then resolves to
/// nothing. For a writer that speaks of another writer's containers, whose end it learns of only
/// afterwards.
template <class T>
struct WeakRef {
    Id id = {};

    constexpr WeakRef() noexcept = default;
    constexpr explicit WeakRef(Id target) noexcept : id{target} {}
    template <std::derived_from<T> U>
    WeakRef(const U& container) noexcept : id{container.id()} {}

    constexpr explicit operator bool() const noexcept { return static_cast<bool>(id); }
    friend constexpr bool operator==(const WeakRef&, const WeakRef&) = default;
};

}  // namespace gnomon::field

template <>
struct std::hash<gnomon::field::Id> {
    std::size_t operator()(gnomon::field::Id id) const noexcept {
        return static_cast<std::size_t>(id.value * 0x9e3779b97f4a7c15U >> 7U);
    }
};
