#include <gnomon/scene/Types.h>

#include "Datagrams.h"
#include "KnownKey.h"
#include "Messages.h"
#include "Seeds.h"
#include "Types.h"

namespace gnomon::fuzz {
namespace {

template <std::size_t... i>
void addMessages(const Seeds& seeds, const Messages& messages, std::index_sequence<i...>) {
    (seeds.add("wire", std::to_string(i), i, net::body(std::get<i>(messages))), ...);
}

}  // namespace

/// A script of datagrams: see LookupFuzz.cpp for the kinds.
void addLookupSeeds(const Seeds& seeds) {
    const auto ask = net::datagram(net::wire::Lookup::padded(77, "left"));
    const auto right = net::datagram(net::wire::Lookup::padded(77, "right"));
    const auto answer = [](std::uint64_t instance) {
        return net::datagram(net::wire::Announcement{
            .token = 77, .instance = instance, .port = 7430, .server = "left"});
    };
    seeds.add("lookup", "asked", Script{{0, ask}, {0, right}, {4, ask}});
    seeds.add("lookup", "answered", Script{{1, answer(1)}, {0x11, answer(2)}, {2, {}}, {3, {}}});
    seeds.add("lookup", "again", Script{{1, answer(1)}, {2, {}}, {0x21, answer(1)}, {2, {}}});
}

void addWireSeeds(const Seeds& seeds) {
    addLookupSeeds(seeds);
    const std::vector<std::byte> bytes(40, std::byte{7});
    const field::Hash128 hash{.low = 3, .high = 4};
    const auto schema = fuzzTypes().schema();
    const Messages messages{
        {.token = 77, .schema = schema},
        {.n = 5,
         .time = 1.5,
         .flags = 3,
         .needed = {{.hash = hash, .size = 9}, {.size = 10}},
         .released = {{.hash = hash, .serial = 2}},
         .tail = bytes},
        {.n = 5, .tail = bytes},
        {.n = 5},
        {.sentAt = -5},
        {},
        {.hash = hash, .serial = 1, .total = 100, .offset = 50, .tail = bytes},
        {.n = 5, .time = 2, .total = 40, .tail = bytes},
        {.server = "left", .description = "llvmpipe", .schema = schema},
        {.why = "not today"},
        {.n = 5, .min = 0.5F, .max = 40},
        {.n = 5, .shownFrame = 4, .shownAt = 123456789, .images = 2},
        {.n = 5, .digest = 0xfeed},
        {.window = 1, .kind = net::wire::EventKind::scroll, .code = -1, .x = 0.5},
        {.sentAt = 1, .serverClock = 2, .current = 7, .busyMs = 30},
        {.level = net::wire::LogLevel::warning, .text = "hot"},
        {.n = 5, .window = 2, .width = 10, .height = 5, .channels = 3, .tail = bytes},
        {.token = 7, .host = "127.0.0.1", .port = 7430, .after = 3, .uploads = {1, 2}},
        {.token = 7},
        {.token = 7, .why = "refused"},
        {.n = 5, .list = {{.id = 1, .digest = 2}, {.id = 3}}},
        net::wire::Lookup::padded(77, "left"),
        {.token = 77, .instance = 5, .port = 7430, .server = "left"},
        {.inner = 16, .size = 100, .head = bytes, .tail = bytes},
    };
    addMessages(seeds, messages, std::make_index_sequence<messageCount>{});
    seeds.add("wire", "schema", schemaNumber, schema);
    const std::string key = "gnomon-key-1 " + std::string(64, 'a') + "\n";
    seeds.add("wire", "key", keyFileNumber, std::as_bytes(std::span{key}));
}

}  // namespace gnomon::fuzz
