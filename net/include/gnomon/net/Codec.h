#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/field/Wire.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// How messages become bytes and back.
///
/// A message lists its fields once, in wire order:
///
///     struct Swap {
///         static constexpr MessageType type = MessageType::swap;
///         static constexpr std::string_view name = "Swap";
///         std::uint64_t n = 0;
///         template <class Self, class Io>
///         static void fields(Self& self, Io& io) { io(self.n); }
///     };
///
/// A message with `static constexpr bool hasTail = true` ends in `std::span<const std::byte> tail`:
/// bytes without a length of their own, up to the end of the body. After decoding, the tail is a
/// view of the decoded bytes.
namespace gnomon::net {

/// "GNOM", as the first four bytes of a Hello.
inline constexpr std::uint32_t protocolMagic = 0x4d4f4e47;
inline constexpr std::uint32_t protocolVersion = 1;

template <class M>
inline constexpr bool hasTail = requires {
    requires M::hasTail;
};

namespace detail {

/// An enumeration that names its greatest value `last`.
template <class T>
concept WireEnum = std::is_enum_v<T> && requires {
    T::last;
};

/// A struct listed inside a message; `wireBytes` is the least it takes.
template <class T>
concept WireStruct = requires {
    T::wireBytes;
};

class FieldWriter {
public:
    explicit FieldWriter(field::Writer& to) : to_{to} {}

    template <field::Scalar T>
    void operator()(const T& value) {
        to_.scalar(value);
    }
    template <WireEnum T>
    void operator()(const T& value) {
        to_.scalar(static_cast<std::underlying_type_t<T>>(value));
    }
    void operator()(const std::string& text) { to_.string(text); }
    void operator()(const std::vector<std::byte>& bytes) {
        to_.scalar(static_cast<std::uint32_t>(bytes.size()));
        to_.bytes(bytes);
    }
    void operator()(const field::Hash128& hash) {
        to_.scalar(hash.low);
        to_.scalar(hash.high);
    }
    template <WireStruct T>
    void operator()(const T& value) {
        T::fields(value, *this);
    }
    template <WireStruct T>
    void operator()(const std::vector<T>& values) {
        to_.scalar(static_cast<std::uint32_t>(values.size()));
        for (const T& value : values) T::fields(value, *this);
    }
    void operator()(const std::vector<std::uint64_t>& values) {
        to_.scalar(static_cast<std::uint32_t>(values.size()));
        for (const std::uint64_t value : values) to_.scalar(value);
    }

private:
    field::Writer& to_;
};

class FieldReader {
public:
    explicit FieldReader(field::Reader& from) : from_{from} {}

    template <field::Scalar T>
    void operator()(T& value) {
        value = from_.scalar<T>();
    }
    template <WireEnum T>
    void operator()(T& value) {
        const auto raw = from_.scalar<std::underlying_type_t<T>>();
        if (raw > static_cast<std::underlying_type_t<T>>(T::last))
            from_.fail("an enumeration value out of range");
        else
            value = static_cast<T>(raw);
    }
    void operator()(std::string& text) { text = from_.string(); }
    void operator()(std::vector<std::byte>& bytes) {
        const auto data = from_.bytes(from_.scalar<std::uint32_t>());
        bytes.assign(data.begin(), data.end());
    }
    void operator()(field::Hash128& hash) {
        hash.low = from_.scalar<std::uint64_t>();
        hash.high = from_.scalar<std::uint64_t>();
    }
    template <WireStruct T>
    void operator()(T& value) {
        T::fields(value, *this);
    }
    template <WireStruct T>
    void operator()(std::vector<T>& values) {
        const std::size_t count = from_.scalar<std::uint32_t>();
        if (count > from_.remaining() / T::wireBytes) {
            from_.fail("a list that is longer than the message");
            return;
        }
        values.resize(count);
        for (T& value : values) T::fields(value, *this);
    }
    void operator()(std::vector<std::uint64_t>& values) {
        const std::size_t count = from_.scalar<std::uint32_t>();
        if (count > from_.remaining() / sizeof(std::uint64_t)) {
            from_.fail("a list that is longer than the message");
            return;
        }
        values.resize(count);
        for (std::uint64_t& value : values) value = from_.scalar<std::uint64_t>();
    }

private:
    field::Reader& from_;
};

/// The first eight bytes of a Hello: magic and version, the same in every version.
Result<void> checkPreamble(std::string_view message, std::span<const std::byte> body);
Error decodeError(std::string_view message, const field::Reader& from, std::size_t bytes);

}  // namespace detail

/// Length and type, then the fields; a tail is counted in the length but not copied.
template <class M>
std::vector<std::byte> packet(const M& message) {
    field::Writer to;
    to.scalar(std::uint32_t{0});
    to.scalar(static_cast<std::uint32_t>(M::type));
    detail::FieldWriter io{to};
    M::fields(message, io);
    std::size_t length = to.size() - 8;
    if constexpr (hasTail<M>) length += message.tail.size();
    to.patch(0, static_cast<std::uint32_t>(length));
    return to.take();
}

/// What `decode` takes: fields and tail, without length and type.
template <class M>
std::vector<std::byte> body(const M& message) {
    field::Writer to;
    detail::FieldWriter io{to};
    M::fields(message, io);
    if constexpr (hasTail<M>) to.bytes(message.tail);
    return to.take();
}

/// Errors are Errc::protocol and name the message and the byte.
template <class M>
Result<M> decode(std::span<const std::byte> bytes) {
    if constexpr (requires { M::greets; }) {
        if (auto ours = detail::checkPreamble(M::name, bytes); !ours)
            return tl::unexpected{std::move(ours).error()};
    }
    field::Reader from{bytes};
    detail::FieldReader io{from};
    M message{};
    M::fields(message, io);
    if constexpr (hasTail<M>) message.tail = from.bytes(from.remaining());
    if (from.remaining() > 0) from.fail("extra bytes at the end");
    if (!from.failed()) {
        if constexpr (requires { message.wrong(); }) {
            if (const char* why = message.wrong()) from.fail(why);
        }
    }
    if (from.failed()) return tl::unexpected{detail::decodeError(M::name, from, bytes.size())};
    return message;
}

}  // namespace gnomon::net
