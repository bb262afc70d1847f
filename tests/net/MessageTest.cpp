// Every message: there and back, cut short, too long, of another version.
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerMessages.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>

namespace gnomon::net {
namespace {

std::vector<std::byte> someBytes(std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 + 1);
    return bytes;
}

/// A message behind its type: its bytes, and what decoding and encoding again makes of others.
struct Sample {
    const char* name = "";
    std::vector<std::byte> bytes = {};
    std::size_t fixedBytes = 0;  // without the tail
    bool tail = false;
    bool greets = false;
    std::function<Result<std::vector<std::byte>>(std::span<const std::byte>)> again = {};
};

template <class M>
Sample sample(const char* name, const M& message) {
    Sample made{.name = name, .bytes = body(message)};
    made.fixedBytes = made.bytes.size();
    if constexpr (hasTail<M>) made.fixedBytes -= message.tail.size();
    made.tail = hasTail<M>;
    made.greets = requires { M::greets; };
    made.again = [](std::span<const std::byte> bytes) -> Result<std::vector<std::byte>> {
        auto decoded = decode<M>(bytes);
        if (!decoded) return tl::unexpected{std::move(decoded).error()};
        return body(*decoded);
    };
    return made;
}

std::vector<Sample> samples() {
    static const auto tail = someBytes(50);
    const field::Hash128 hash{.low = 3, .high = 4};
    return {
        sample("clientHello",
               wire::ClientHello{.role = wire::Role::bulk,
                                 .token = 77,
                                 .sync = {.timeoutMs = 1, .startTimeoutMs = 2, .waitForLate = true},
                                 .schema = someBytes(30)}),
        sample("frame", wire::Frame{.n = 5,
                                    .time = 1.5,
                                    .flags = 3,
                                    .needed = {{.hash = hash, .size = 9}, {.size = 10}},
                                    .released = {{.hash = hash, .serial = 2}},
                                    .tail = tail}),
        sample("fit", wire::Fit{.n = 5, .tail = tail}),
        sample("swap", wire::Swap{.n = 5}),
        sample("ping", wire::Ping{.sentAt = -5}),
        sample("payload",
               wire::Payload{.hash = hash, .serial = 1, .total = 100, .offset = 50, .tail = tail}),
        sample("snapshot",
               wire::Snapshot{.n = 5, .time = 2, .total = 50, .offset = 0, .tail = tail}),
        sample("packed",
               wire::Packed{.inner = 16, .size = 100, .head = someBytes(40), .tail = tail}),
        sample("snapshotBody",
               wire::SnapshotBody{.needed = {{.hash = hash, .size = 9}}, .tail = tail}),
        sample("relay",
               wire::Relay{
                   .token = 7, .host = "wall01", .port = 7430, .after = 12, .uploads = {3, 12}}),
        sample("relayEnd", wire::RelayEnd{.token = 7}),
        sample("relayLost", wire::RelayLost{.token = 7, .why = "refused"}),
        sample("serverHello",
               wire::ServerHello{
                   .server = "left", .description = "llvmpipe", .schema = someBytes(20)}),
        sample("refused", wire::Refused{.why = "not today", .cure = wire::Cure::restart}),
        sample("depth", wire::Depth{.n = 5, .min = 0.5F, .max = 40}),
        sample("ready", wire::Ready{.n = 5,
                                    .shownFrame = 4,
                                    .shownAt = 123456789,
                                    .images = 2,
                                    .stats = {.renderMs = 3, .triangles = 1000}}),
        sample("digest", wire::Digest{.n = 5, .digest = 0xfeedULL}),
        sample("digests", wire::Digests{.n = 5, .list = {{.id = 1, .digest = 2}, {.id = 3}}}),
        sample("event",
               wire::Event{.window = 1, .kind = wire::EventKind::scroll, .code = -1, .x = 0.5}),
        sample("pong", wire::Pong{.sentAt = 1,
                                  .serverClock = 2,
                                  .current = 7,
                                  .busyMs = 30,
                                  .activity = wire::Activity::compiling}),
        sample("log", wire::Log{.level = wire::LogLevel::warning, .text = "hot"}),
        sample("image", wire::Image{.n = 5,
                                    .window = 2,
                                    .width = 10,
                                    .height = 5,
                                    .channels = 3,
                                    .offset = 100,
                                    .tail = tail}),
        sample("lookup", wire::Lookup::padded(77, "left")),
        sample("announcement",
               wire::Announcement{.token = 77, .instance = 5, .port = 7430, .server = "left"}),
    };
}

class EveryMessage : public testing::TestWithParam<Sample> {};

TEST_P(EveryMessage, ComesBackAsItWas) {
    const auto again = GetParam().again(GetParam().bytes);
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ(*again, GetParam().bytes);
}

TEST_P(EveryMessage, CutShortIsRefused) {
    const std::span<const std::byte> whole{GetParam().bytes};
    for (std::size_t size = 0; size < GetParam().fixedBytes; ++size) {
        const auto cut = GetParam().again(whole.first(size));
        ASSERT_FALSE(cut) << size;
        EXPECT_EQ(cut.error().code, Errc::protocol);
    }
}

TEST_P(EveryMessage, WithExtraBytesIsRefused) {
    if (GetParam().tail) GTEST_SKIP() << "its tail takes all bytes there are";
    auto longer = GetParam().bytes;
    longer.push_back(std::byte{0});
    const auto refused = GetParam().again(longer);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("extra bytes"), std::string::npos);
}

TEST_P(EveryMessage, OfAnotherVersionIsRefusedByNumber) {
    if (!GetParam().greets) GTEST_SKIP() << "only Hello carries the version";
    auto other = GetParam().bytes;
    other[4] = std::byte{9};
    const auto refused = GetParam().again(other);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("protocol version 9, expected 1"), std::string::npos);
    other[0] = std::byte{0};
    EXPECT_NE(GetParam().again(other).error().what.find("not a Gnomon program"), std::string::npos);
}

/// Random damage must be refused or decoded into something that encodes again; never worse.
TEST_P(EveryMessage, SurvivesDamage) {
    std::mt19937 random{1};
    for (int round = 0; round < 2000; ++round) {
        auto damaged = GetParam().bytes;
        for (unsigned i = 0; i < 1 + random() % 4; ++i)
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        const auto again = GetParam().again(damaged);
        if (!again) continue;
        EXPECT_EQ(*again, damaged);
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryMessage, testing::ValuesIn(samples()),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Messages, APacketIsLengthTypeBody) {
    const auto bytes = packet(wire::Swap{.n = 0x0102030405060708});
    ASSERT_EQ(bytes.size(), 16U);
    const unsigned char expected[] = {8, 0, 0, 0, 4, 0, 0, 0, 8, 7, 6, 5, 4, 3, 2, 1};
    EXPECT_EQ(std::memcmp(bytes.data(), expected, 16), 0);
}

TEST(Messages, ATailCountsInTheLengthButIsNotCopied) {
    const auto tail = someBytes(1000);
    const auto bytes = packet(wire::Fit{.n = 1, .tail = tail});
    ASSERT_EQ(bytes.size(), 16U);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    EXPECT_EQ(length, 1008U);
}

TEST(Messages, AListLongerThanItsMessageAllocatesNothing) {
    auto bytes = body(wire::Frame{.n = 1});
    const std::uint32_t many = 0xffffffff;
    std::memcpy(bytes.data() + 20, &many, 4);  // how many payloads are needed
    const auto refused = decode<wire::Frame>(bytes);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("longer than the message"), std::string::npos);
}

struct Nonsense {
    const char* name = "";
    Result<void> outcome = {};
    const char* why = "";
};

template <class M>
Result<void> outcomeOf(const M& message) {
    const auto bytes = body(message);
    auto decoded = decode<M>(bytes);
    if (!decoded) return tl::unexpected{std::move(decoded).error()};
    return {};
}

TEST(Messages, ValuesThatMakeNoSenseAreRefused) {
    const auto tail = someBytes(10);
    const Nonsense rows[] = {
        {"flags", outcomeOf(wire::Frame{.flags = 32}), "unknown flags"},
        {"partOutside", outcomeOf(wire::Payload{.total = 10, .offset = 1, .tail = tail}),
         "outside"},
        {"offsetOutside",
         outcomeOf(wire::Payload{.total = 10, .offset = ~std::uint64_t{0}, .tail = tail}),
         "outside"},
        {"emptyPart", outcomeOf(wire::Payload{.total = 10}), "outside"},
        {"hugePayload", outcomeOf(wire::Payload{.total = std::uint64_t{1} << 60U, .tail = tail}),
         "out of range"},
        {"hugeSnapshot", outcomeOf(wire::Snapshot{.total = std::uint64_t{1} << 60U, .tail = tail}),
         "out of range"},
        {"snapshotOutside", outcomeOf(wire::Snapshot{.total = 9, .tail = tail}), "outside"},
        {"twoChannels",
         outcomeOf(wire::Image{.width = 1, .height = 1, .channels = 2, .tail = tail}), "RGB"},
        {"hugeImage",
         outcomeOf(wire::Image{.width = 65536, .height = 65536, .channels = 4, .tail = tail}),
         "out of range"},
        {"imageOutside",
         outcomeOf(wire::Image{.width = 1, .height = 1, .channels = 3, .tail = tail}), "outside"},
    };
    for (const Nonsense& row : rows) {
        ASSERT_FALSE(row.outcome) << row.name;
        EXPECT_NE(row.outcome.error().what.find(row.why), std::string::npos)
            << row.name << ": " << row.outcome.error().what;
    }
}

TEST(Messages, EachHasItsRouteAndLimit) {
    const auto limit = [](Route route, MessageType type) {
        return limitOf(route, static_cast<std::uint32_t>(type));
    };
    EXPECT_TRUE(limit(Route::toServerGreeting, MessageType::clientHello).allowed);
    EXPECT_FALSE(limit(Route::toServerGreeting, MessageType::frame).allowed);
    EXPECT_FALSE(limit(Route::toServerControl, MessageType::payload).allowed);
    EXPECT_FALSE(limit(Route::toServerBulk, MessageType::frame).allowed);
    EXPECT_FALSE(limit(Route::toClientControl, MessageType::image).allowed);
    EXPECT_FALSE(limitOf(Route::toServerControl, 12345).allowed);
    EXPECT_EQ(limit(Route::toServerControl, MessageType::frame).bytes, maxChangeBytes);
    EXPECT_GT(limit(Route::toServerBulk, MessageType::payload).bytes, chunkBytes);
}

}  // namespace
}  // namespace gnomon::net
