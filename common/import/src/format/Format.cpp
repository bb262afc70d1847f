#include "format/Format.h"

#include <gnomon/field/Wire.h>
#include <gnomon/scene/Imported.h>

#include <algorithm>

namespace gnomon::importer {

std::array<std::byte, StreamHeader::bytes> encoded(const StreamHeader& header) {
    field::Writer to;
    to.scalar(StreamHeader::magic);
    to.scalar(StreamHeader::version);
    to.scalar(header.types.low);
    to.scalar(header.types.high);
    to.scalar(header.listBytes);
    to.scalar(header.payloadBytes);
    to.scalar(header.payloads);
    std::array<std::byte, StreamHeader::bytes> out{};
    std::copy(to.written().begin(), to.written().end(), out.begin());
    return out;
}

std::optional<StreamHeader> decodedHeader(std::span<const std::byte, StreamHeader::bytes> bytes) {
    field::Reader from{bytes};
    const auto magic = from.scalar<std::uint32_t>();
    const auto version = from.scalar<std::uint32_t>();
    if (magic != StreamHeader::magic || version != StreamHeader::version) return {};
    StreamHeader header;
    header.types.low = from.scalar<std::uint64_t>();
    header.types.high = from.scalar<std::uint64_t>();
    header.listBytes = from.scalar<std::uint64_t>();
    header.payloadBytes = from.scalar<std::uint64_t>();
    header.payloads = from.scalar<std::uint64_t>();
    return header;
}

field::Hash128 typesDigest(const field::TypeRegistry& types) {
    auto text = types.schema();
    // schema() leaves out what does not travel to servers, but travels here.
    const auto add = [&](const field::TypeInfo& info) {
        const auto put = [&](std::string_view s) {
            const auto raw = std::as_bytes(std::span{s});
            text.insert(text.end(), raw.begin(), raw.end());
            text.push_back(std::byte{0});
        };
        put(info.name);
        for (const auto& field : info.fields) {
            put(field.name);
            put(field.layout);
        }
    };
    add(types.of<scene::AnimationChannel>());
    add(types.of<scene::AnimationPose>());
    add(types.of<scene::Animation>());
    add(types.of<scene::ImportedScene>());
    return field::contentHash(text);
}

}  // namespace gnomon::importer
