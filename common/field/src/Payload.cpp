#include <gnomon/field/Payload.h>
#include <gnomon/field/Wire.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace gnomon::field {

Hash128 contentHash(std::span<const std::byte> bytes) noexcept {
    const auto hash = XXH3_128bits(bytes.data(), bytes.size());
    return {.low = hash.low64, .high = hash.high64};
}

Payload::Payload(std::vector<std::byte> bytes) {
    if (bytes.empty()) return;
    auto data = std::make_shared<Data>();
    data->hash = contentHash(bytes);
    data->bytes = std::move(bytes);
    data_ = std::move(data);
}

Payload Reader::payload() {
    const Hash128 hash{.low = scalar<std::uint64_t>(), .high = scalar<std::uint64_t>()};
    const auto size = scalar<std::uint64_t>();
    if (failed_ || size == 0) {
        if (!failed_ && hash != Hash128{}) fail("an empty payload with a hash");
        return {};
    }
    Payload found = payloads_ == nullptr ? Payload{} : payloads_->find(hash);
    if (!found || found.size() != size) {
        fail("a payload that has not arrived");
        return {};
    }
    return found;
}

}  // namespace gnomon::field
