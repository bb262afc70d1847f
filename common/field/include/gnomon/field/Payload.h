#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::field {

/// 128-bit content address (XXH3). Guards against mistakes, not against attackers.
struct Hash128 {
    std::uint64_t low = 0;
    std::uint64_t high = 0;
    friend bool operator==(const Hash128&, const Hash128&) = default;
};

Hash128 contentHash(std::span<const std::byte> bytes) noexcept;

/// Bulk data (vertices, indices, pixels): immutable, shared between aspects and threads, named by
/// its content. Copying costs a pointer. An empty payload has no bytes and the hash {0, 0}.
class Payload {
public:
    Payload() noexcept = default;
    explicit Payload(std::vector<std::byte> bytes);
    /// Copies the object representation of a range of trivially copyable items.
    template <class T>
    static Payload of(std::span<const T> items) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto bytes = std::as_bytes(items);
        return Payload{std::vector<std::byte>(bytes.begin(), bytes.end())};
    }

    std::span<const std::byte> bytes() const noexcept {
        return data_ ? std::span<const std::byte>{data_->bytes} : std::span<const std::byte>{};
    }
    /// The bytes as items of type T; a remainder smaller than one item is left out.
    template <class T>
    std::span<const T> as() const noexcept {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto raw = bytes();
        return {reinterpret_cast<const T*>(raw.data()), raw.size() / sizeof(T)};
    }
    Hash128 hash() const noexcept { return data_ ? data_->hash : Hash128{}; }
    std::size_t size() const noexcept { return bytes().size(); }
    explicit operator bool() const noexcept { return data_ != nullptr; }
    friend bool operator==(const Payload& a, const Payload& b) noexcept {
        return a.hash() == b.hash();
    }

private:
    friend class PayloadStore;
    struct Data {
        Hash128 hash = {};
        std::vector<std::byte> bytes = {};
    };
    explicit Payload(std::shared_ptr<const Data> data) noexcept : data_{std::move(data)} {}
    std::shared_ptr<const Data> data_;
};

}  // namespace gnomon::field

template <>
struct std::hash<gnomon::field::Hash128> {
    std::size_t operator()(const gnomon::field::Hash128& h) const noexcept {
        return static_cast<std::size_t>(h.low);
    }
};
