#pragma once

#include <gnomon/field/Id.h>
#include <gnomon/field/Payload.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::field {

static_assert(std::endian::native == std::endian::little,
              "the wire is little-endian; scalars are copied as they are");

template <class T>
concept Scalar = std::is_arithmetic_v<T>;

/// Appends little-endian scalars to a growing buffer.
class Writer {
public:
    template <Scalar T>
    void scalar(T value) {
        std::memcpy(room(sizeof(T)), &value, sizeof(T));
    }
    void bytes(std::span<const std::byte> data) {
        if (!data.empty()) std::memcpy(room(data.size()), data.data(), data.size());
    }
    void id(Id value) { scalar(value.value); }
    /// u32 length in bytes, then the bytes (UTF-8).
    void string(std::string_view text) {
        scalar(static_cast<std::uint32_t>(text.size()));
        bytes(std::as_bytes(std::span{text}));
    }
    /// 16 bytes of hash, u64 size. The bytes travel apart; payloads() lists what was named.
    void payload(const Payload& value) {
        scalar(value.hash().low);
        scalar(value.hash().high);
        scalar(static_cast<std::uint64_t>(value.size()));
        if (value) payloads_.push_back(value);
    }

    std::size_t size() const noexcept { return size_; }
    std::span<const std::byte> written() const noexcept { return {buffer_.data(), size_}; }
    /// Overwrites a u32 written before, for counts known only later.
    void patch(std::size_t at, std::uint32_t value) {
        std::memcpy(buffer_.data() + at, &value, sizeof value);
    }
    void clear() noexcept {
        size_ = 0;
        payloads_.clear();
    }
    std::vector<std::byte> take() {
        buffer_.resize(size_);
        size_ = 0;
        return std::move(buffer_);
    }
    std::vector<Payload> takePayloads() { return std::move(payloads_); }

private:
    std::byte* room(std::size_t count) {
        if (buffer_.size() - size_ < count)
            buffer_.resize(std::max(buffer_.size() * 2, size_ + count + 256));
        std::byte* at = buffer_.data() + size_;
        size_ += count;
        return at;
    }

    std::vector<std::byte> buffer_;
    std::size_t size_ = 0;
    std::vector<Payload> payloads_;
};

/// Where a Reader finds the payloads that the bytes name.
class PayloadSource {
public:
    virtual ~PayloadSource() = default;
    /// An empty payload where it is not known.
    virtual Payload find(const Hash128& hash) const = 0;
};

/// Reads what a Writer wrote, from bytes that may be hostile. Reading past the end, or anything
/// else that is wrong, makes the reader fail for good: values read from then on are zero, and the
/// caller looks at failed() once per entry.
class Reader {
public:
    /// Largest id that a reader with an offset accepts.
    static constexpr std::uint64_t maxMoved = std::uint64_t{1} << 32U;

    explicit Reader(std::span<const std::byte> bytes, const PayloadSource* payloads = nullptr,
                    std::uint64_t idOffset = 0) noexcept
        : bytes_{bytes}, payloads_{payloads}, idOffset_{idOffset} {}

    template <Scalar T>
    T scalar() noexcept {
        T value{};
        if (remaining() < sizeof(T)) {
            fail("cut short");
            return value;
        }
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t raw = 0;
            std::memcpy(&raw, bytes_.data() + at_, 1);
            if (raw > 1) fail("a truth value that is neither 0 nor 1");
            value = raw == 1;
        } else {
            std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        }
        at_ += sizeof(T);
        return value;
    }
    Id id() noexcept {
        Id value{scalar<std::uint64_t>()};
        if (!value || idOffset_ == 0) return value;
        if (value.value > maxMoved) {
            fail("an id too large to be moved");
            return {};
        }
        return {value.value + idOffset_};
    }
    std::string string() {
        const auto data = bytes(scalar<std::uint32_t>());
        return {reinterpret_cast<const char*>(data.data()), data.size()};
    }
    std::span<const std::byte> bytes(std::size_t count) noexcept {
        if (remaining() < count) {
            fail("cut short");
            return {};
        }
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    Payload payload();

    std::size_t at() const noexcept { return at_; }
    std::size_t remaining() const noexcept { return failed_ ? 0 : bytes_.size() - at_; }
    void fail(const char* why) noexcept {
        if (!failed_) why_ = why;
        failed_ = true;
    }
    bool failed() const noexcept { return failed_; }
    const char* why() const noexcept { return why_; }

private:
    std::span<const std::byte> bytes_;
    const PayloadSource* payloads_;
    std::uint64_t idOffset_;
    std::size_t at_ = 0;
    bool failed_ = false;
    const char* why_ = "";
};

}  // namespace gnomon::field
