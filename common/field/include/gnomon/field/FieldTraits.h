#pragma once

#include <gnomon/field/Wire.h>

#include <cstdint>
#include <string>
#include <type_traits>

namespace gnomon::field {

/// How a value type travels. `layout` names its scalars, one letter each, so that a reader which
/// does not know the type can still step over it, keep it and print it:
///   b bool (1 byte)  B u8  i i32  u u32  I i64  U u64  f float  d double
///   s string (u32 length, bytes)   r reference (u64 id)   p payload (16 bytes hash, u64 size)
/// s, r and p stand alone. Specialise it for a type of your own.
template <class T>
struct FieldTraits;

template <class T, char letter>
struct ScalarTraits {
    static constexpr char layoutText[] = {letter, '\0'};
    static constexpr std::string_view layout{layoutText, 1};
    static void write(Writer& to, T value) { to.scalar(value); }
    static T read(Reader& from) { return from.scalar<T>(); }
};

template <>
struct FieldTraits<bool> : ScalarTraits<bool, 'b'> {};
template <>
struct FieldTraits<std::uint8_t> : ScalarTraits<std::uint8_t, 'B'> {};
template <>
struct FieldTraits<std::int32_t> : ScalarTraits<std::int32_t, 'i'> {};
template <>
struct FieldTraits<std::uint32_t> : ScalarTraits<std::uint32_t, 'u'> {};
template <>
struct FieldTraits<std::int64_t> : ScalarTraits<std::int64_t, 'I'> {};
template <>
struct FieldTraits<std::uint64_t> : ScalarTraits<std::uint64_t, 'U'> {};
template <>
struct FieldTraits<float> : ScalarTraits<float, 'f'> {};
template <>
struct FieldTraits<double> : ScalarTraits<double, 'd'> {};

template <>
struct FieldTraits<std::string> {
    static constexpr std::string_view layout = "s";
    static void write(Writer& to, const std::string& value) { to.string(value); }
    static std::string read(Reader& from) { return from.string(); }
};

template <class T>
struct FieldTraits<Ref<T>> {
    static constexpr std::string_view layout = "r";
    static void write(Writer& to, Ref<T> value) { to.id(value.id); }
    static Ref<T> read(Reader& from) { return Ref<T>{from.id()}; }
};

/// As u64: it keeps nothing, and is not moved when its container is adopted.
template <class T>
struct FieldTraits<WeakRef<T>> {
    static constexpr std::string_view layout = "U";
    static void write(Writer& to, WeakRef<T> value) { to.id(value.id); }
    static WeakRef<T> read(Reader& from) { return WeakRef<T>{Id{from.scalar<std::uint64_t>()}}; }
};

template <>
struct FieldTraits<Payload> {
    static constexpr std::string_view layout = "p";
    static void write(Writer& to, const Payload& value) { to.payload(value); }
    static Payload read(Reader& from) { return from.payload(); }
};

/// Enumerations travel as u32. A value the receiver does not know is clamped to the last one it
/// does, which the enumeration names `last`.
template <class T>
requires std::is_enum_v<T>
struct FieldTraits<T> {
    static constexpr std::string_view layout = "u";
    static void write(Writer& to, T value) { to.scalar(static_cast<std::uint32_t>(value)); }
    static T read(Reader& from) {
        const auto raw = from.scalar<std::uint32_t>();
        if (raw > static_cast<std::uint32_t>(T::last)) {
            from.fail("an enumeration value out of range");
            return T{};
        }
        return static_cast<T>(raw);
    }
};

/// Smallest size in bytes of one value with this layout.
constexpr std::size_t minimumBytes(std::string_view layout) noexcept {
    std::size_t total = 0;
    for (const char letter : layout) {
        switch (letter) {
            case 'b':
            case 'B':
                total += 1;
                break;
            case 'i':
            case 'u':
            case 'f':
            case 's':
                total += 4;
                break;
            case 'p':
                total += 24;
                break;
            default:
                total += 8;
                break;
        }
    }
    return total;
}

template <class T>
inline constexpr bool isRef = false;
template <class T>
inline constexpr bool isRef<Ref<T>> = true;

}  // namespace gnomon::field
