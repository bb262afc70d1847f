// Each decoder by itself: what it accepts must be what the encoder makes of it, byte for byte. The
// first byte picks the message; the last choices are schemas and key files.
#include <gnomon/field/Aspect.h>
#include <gnomon/net/ClusterKey.h>
#include <gnomon/scene/Types.h>

#include <algorithm>

#include "Check.h"
#include "Messages.h"

namespace gnomon::fuzz {
namespace {

using Bytes = std::span<const std::byte>;

template <class M>
void roundTrip(Bytes bytes) {
    const auto message = net::decode<M>(bytes);
    if (!message) return;
    require(std::ranges::equal(net::body(*message), bytes), "an accepted message comes back");
}

/// What is agreed on can be said again, and containers of it live and travel.
void agree(Bytes bytes) {
    field::TypeRegistry types;
    scene::addTypes(types);
    if (!types.agree(bytes, "a stranger")) return;
    require(types.agree(bytes, "a stranger").has_value(), "a schema can be agreed on twice");
    field::TypeRegistry other;
    require(other.agree(types.schema(), "ourselves").has_value(), "our own schema is sound");
    field::Aspect aspect{types, 2};
    field::Reader from{bytes};
    const auto count = from.scalar<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto* type = types.find(field::typeIdOf(from.string()));
        require(type != nullptr, "a type that was agreed on is known");
        if (type->replicated) aspect.create(*type);
        const auto fields = from.scalar<std::uint32_t>();
        for (std::uint32_t k = 0; k < fields; ++k) {
            from.string();
            from.string();
            from.scalar<std::uint8_t>();
        }
    }
    aspect.commit();
    field::Aspect follower{types, 0};
    require(follower.apply(aspect.snapshot()).has_value(), "its containers travel");
    require(follower.digest() == aspect.digest(), "and arrive as they were");
}

void keyFile(Bytes bytes) {
    const std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    if (const auto key = net::ClusterKey::parse(text))
        require(key->fingerprint().size() == 16, "a key has a fingerprint");
}

template <std::size_t... i>
void decodeMessage(std::size_t number, Bytes bytes, std::index_sequence<i...>) {
    ((i == number ? roundTrip<std::tuple_element_t<i, Messages>>(bytes) : void()), ...);
}

void decode(std::size_t number, Bytes bytes) {
    if (number == schemaNumber)
        agree(bytes);
    else if (number == keyFileNumber)
        keyFile(bytes);
    else
        decodeMessage(number, bytes, std::make_index_sequence<messageCount>{});
}

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    if (size == 0) return 0;
    decode(data[0] % (messageCount + 2), std::as_bytes(std::span{data + 1, size - 1}));
    return 0;
}
