#include "Packer.h"

#include <fmt/format.h>
#include <gnomon/net/ClientMessages.h>
#include <lz4.h>

#include <algorithm>
#include <cstring>

namespace gnomon::net {
namespace {

/// What is not a tenth smaller goes as it is.
constexpr std::size_t worthIt(std::size_t bytes) { return bytes - bytes / 10; }

}  // namespace

bool Packer::pays(const Channel& channel) const {
    if (use_ != Compress::automatic) return use_ == Compress::always;
    const auto rate = channel.deliveryRate();
    return rate && packingPays(*rate, rate_);
}

const Packer::Packed& Packer::pack(const Part& chunk) {
    const auto found = std::find_if(lately_.begin(), lately_.end(), [&](const Packed& one) {
        return one.chunk.bytes.data() == chunk.bytes.data() &&
               one.chunk.bytes.size() == chunk.bytes.size();
    });
    if (found != lately_.end()) return *found;
    if (lately_.size() == kept) lately_.pop_front();
    Packed& made = lately_.emplace_back(Packed{.chunk = chunk});
    const std::size_t size = chunk.bytes.size();
    std::vector<std::byte> packed(worthIt(size));
    const auto from = SteadyClock::now();
    const int count = LZ4_compress_default(reinterpret_cast<const char*>(chunk.bytes.data()),
                                           reinterpret_cast<char*>(packed.data()),
                                           static_cast<int>(size), static_cast<int>(packed.size()));
    const std::chrono::duration<double> took = SteadyClock::now() - from;
    // Small ones tell little, and one that was interrupted nothing: slowly.
    if (size >= chunkBytes / 8 && took.count() > 0.0)
        rate_ += 0.125 * (static_cast<double>(size) / took.count() - rate_);
    if (count <= 0) return made;
    packed.resize(static_cast<std::size_t>(count));
    packed.shrink_to_fit();
    made.packed = Part::of(std::move(packed));
    return made;
}

void Packer::queue(Channel& channel, std::vector<std::byte> head, const Part& chunk) {
    if (pays(channel)) {
        if (const Packed& one = pack(chunk); !one.packed.bytes.empty()) {
            std::uint32_t inner = 0;
            std::memcpy(&inner, head.data() + 4, sizeof inner);
            head.erase(head.begin(), head.begin() + 8);
            channel.queue(
                Part::of(packet(wire::Packed{.inner = inner,
                                             .size = static_cast<std::uint32_t>(chunk.bytes.size()),
                                             .head = std::move(head),
                                             .tail = one.packed.bytes})));
            channel.queue(one.packed);
            spared_ += chunk.bytes.size() - one.packed.bytes.size();
            return;
        }
    }
    channel.queue(Part::of(std::move(head)));
    channel.queue(chunk);
}

Result<Unpacker::Unpacked> Unpacker::unpack(std::span<const std::byte> body) {
    auto packed = decode<wire::Packed>(body);
    if (!packed) return tl::unexpected{std::move(packed).error()};
    const std::size_t head = packed->head.size();
    body_.resize(head + packed->size);
    std::copy(packed->head.begin(), packed->head.end(), body_.begin());
    const int count =
        LZ4_decompress_safe(reinterpret_cast<const char*>(packed->tail.data()),
                            reinterpret_cast<char*>(body_.data() + head),
                            static_cast<int>(packed->tail.size()), static_cast<int>(packed->size));
    if (count < 0 || static_cast<std::uint32_t>(count) != packed->size)
        return tl::unexpected{
            Error{.code = Errc::protocol,
                  .what = fmt::format("Packed: {} bytes that are not {} bytes compressed by LZ4",
                                      packed->tail.size(), packed->size)}};
    return Unpacked{.type = static_cast<MessageType>(packed->inner), .body = body_};
}

}  // namespace gnomon::net
