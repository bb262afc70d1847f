// The server's two streams put together, without sockets.
#include <gtest/gtest.h>

#include "FrameGate.h"

namespace gnomon::net {
namespace {

std::vector<std::byte> content(std::size_t size, int seed) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = static_cast<std::byte>(i * 31 + static_cast<std::size_t>(seed));
    return bytes;
}

struct Gate {
    std::vector<ServerEvent> events = {};
    FrameGate gate;

    explicit Gate(std::uint64_t budget = 1'000'000)
        : gate{budget,
               [this](ServerEvent event, std::size_t) { events.push_back(std::move(event)); }} {}

    Result<void> upload(const std::vector<std::byte>& bytes, std::uint64_t serial,
                        std::size_t chunk = 1000) {
        const std::span<const std::byte> all{bytes};
        for (std::size_t at = 0; at < bytes.size(); at += chunk) {
            auto done = gate.payload({.hash = field::contentHash(bytes),
                                      .serial = serial,
                                      .total = bytes.size(),
                                      .offset = at,
                                      .tail = all.subspan(at, std::min(chunk, bytes.size() - at))});
            if (!done) return done;
        }
        return {};
    }
    Result<void> snapshot(std::uint64_t n, std::vector<wire::PayloadName> needed = {}) {
        const auto whole = body(wire::SnapshotBody{.needed = std::move(needed)});
        return gate.snapshot({.n = n, .total = whole.size(), .tail = whole});
    }
    Result<void> frame(std::uint64_t n, std::vector<wire::PayloadName> needed = {},
                       std::vector<wire::PayloadRelease> released = {}) {
        return gate.frame({.n = n, .needed = std::move(needed), .released = std::move(released)});
    }
    template <class E>
    const E* last() const {
        return events.empty() ? nullptr : std::get_if<E>(&events.back());
    }
};

wire::PayloadName nameOf(const std::vector<std::byte>& bytes) {
    return {.hash = field::contentHash(bytes), .size = bytes.size()};
}

TEST(FrameGate, HoldsEverythingBackUntilTheSnapshotIsThere) {
    Gate gate;
    ASSERT_TRUE(gate.gate.swap({.n = 4}));
    ASSERT_TRUE(gate.frame(6));
    ASSERT_TRUE(gate.gate.swap({.n = 6}));
    EXPECT_TRUE(gate.events.empty());
    EXPECT_GT(gate.gate.waitingBytes(), 0U);
    ASSERT_TRUE(gate.snapshot(5));
    ASSERT_EQ(gate.events.size(), 3U);  // the swap of frame 4 concerns nothing here
    EXPECT_EQ(std::get<Snapshot>(gate.events[0]).n, 5U);
    EXPECT_EQ(std::get<Frame>(gate.events[1]).n, 6U);
    EXPECT_EQ(std::get<Swap>(gate.events[2]).n, 6U);
    EXPECT_EQ(gate.gate.waitingBytes(), 0U);
}

TEST(FrameGate, AFrameWaitsForItsPayloadsAndHoldsBackWhatFollows) {
    Gate gate;
    const auto bytes = content(2500, 1);
    ASSERT_TRUE(gate.snapshot(0));
    ASSERT_TRUE(gate.frame(1, {nameOf(bytes)}));
    ASSERT_TRUE(gate.frame(2));
    EXPECT_EQ(gate.events.size(), 1U);
    ASSERT_TRUE(gate.upload(bytes, 1));
    ASSERT_EQ(gate.events.size(), 3U);
    const auto& frame = std::get<Frame>(gate.events[1]);
    ASSERT_EQ(frame.changes.payloads.size(), 1U);
    EXPECT_EQ(frame.changes.payloads[0].hash(), nameOf(bytes).hash);
    EXPECT_EQ(std::get<Frame>(gate.events[2]).n, 2U);
}

TEST(FrameGate, AReleasedPayloadIsAwaitedAgain) {
    Gate gate;
    const auto bytes = content(10, 1);
    ASSERT_TRUE(gate.snapshot(0));
    ASSERT_TRUE(gate.upload(bytes, 1));
    ASSERT_TRUE(gate.frame(1, {nameOf(bytes)}, {{.hash = nameOf(bytes).hash, .serial = 1}}));
    EXPECT_EQ(gate.last<Frame>()->changes.payloads.size(), 1U);
    ASSERT_TRUE(gate.frame(2, {nameOf(bytes)}));
    EXPECT_EQ(gate.last<Frame>()->n, 1U);
    ASSERT_TRUE(gate.upload(bytes, 2));
    EXPECT_EQ(gate.last<Frame>()->n, 2U);
}

TEST(FrameGate, AReleaseThatComesAfterTheNextUploadDoesNotTakeIt) {
    Gate gate;
    const auto bytes = content(10, 1);
    ASSERT_TRUE(gate.snapshot(0));
    ASSERT_TRUE(gate.upload(bytes, 1));
    ASSERT_TRUE(gate.upload(bytes, 2));  // bulk ran ahead of control
    ASSERT_TRUE(gate.frame(1, {}, {{.hash = nameOf(bytes).hash, .serial = 1}}));
    ASSERT_TRUE(gate.frame(2, {nameOf(bytes)}));
    EXPECT_EQ(gate.last<Frame>()->n, 2U);
}

TEST(FrameGate, ASnapshotWaitsForTheChangesAndPayloadsItNames) {
    Gate gate;
    const auto one = content(100, 1), other = content(100, 2), list = content(30, 3);
    ASSERT_TRUE(gate.upload(one, 1));
    const auto whole =
        body(wire::SnapshotBody{.needed = {nameOf(one), nameOf(other)}, .tail = list});
    const std::span<const std::byte> all{whole};
    ASSERT_TRUE(gate.gate.snapshot({.n = 3, .total = all.size(), .tail = all.first(20)}));
    ASSERT_TRUE(
        gate.gate.snapshot({.n = 3, .total = all.size(), .offset = 20, .tail = all.subspan(20)}));
    ASSERT_TRUE(gate.frame(4));
    EXPECT_TRUE(gate.events.empty());
    ASSERT_TRUE(gate.upload(other, 2));
    ASSERT_EQ(gate.events.size(), 2U);
    const auto* snapshot = std::get_if<Snapshot>(&gate.events[0]);
    ASSERT_NE(snapshot, nullptr);
    EXPECT_EQ(snapshot->changes.bytes, list);
    EXPECT_EQ(snapshot->changes.payloads.size(), 2U);
}

TEST(FrameGate, AMalformedSnapshotIsRefused) {
    Gate gate;
    const auto bytes = content(30, 3);  // announces far more payloads than there are bytes
    ASSERT_FALSE(gate.gate.snapshot({.n = 3, .total = 30, .tail = bytes}));
}

Result<void> part(FrameGate& gate, const std::vector<std::byte>& bytes, std::size_t at,
                  std::size_t size, FrameGate::Source source) {
    return gate.payload({.hash = field::contentHash(bytes),
                         .serial = 1,
                         .total = bytes.size(),
                         .offset = at,
                         .tail = std::span{bytes}.subspan(at, size)},
                        source);
}

TEST(FrameGate, TheSamePayloadFromTwoSourcesIsTakenOnce) {
    using enum FrameGate::Source;
    Gate gate;
    const auto bytes = content(100, 1);
    ASSERT_TRUE(gate.snapshot(0));
    ASSERT_TRUE(part(gate.gate, bytes, 0, 60, relay));
    ASSERT_TRUE(part(gate.gate, bytes, 0, 30, client));
    EXPECT_EQ(gate.gate.unfinished(1).size(), 60U);
    ASSERT_TRUE(part(gate.gate, bytes, 60, 40, relay));
    ASSERT_TRUE(gate.frame(1, {nameOf(bytes)}, {{.hash = nameOf(bytes).hash, .serial = 1}}));
    EXPECT_EQ(gate.last<Frame>()->n, 1U);
    ASSERT_TRUE(part(gate.gate, bytes, 30, 70, client));
    EXPECT_TRUE(gate.gate.kept().empty());  // released before: it is not kept for ever
}

TEST(FrameGate, WhatALostRelayBeganIsForgotten) {
    using enum FrameGate::Source;
    Gate gate;
    const auto bytes = content(100, 1);
    ASSERT_TRUE(part(gate.gate, bytes, 0, 60, relay));
    gate.gate.sourceEnded(relay);
    EXPECT_TRUE(gate.gate.unfinished(1).empty());
    ASSERT_TRUE(part(gate.gate, bytes, 0, 100, relay));
    EXPECT_EQ(gate.gate.kept().size(), 1U);
}

void expectRefused(const Result<void>& outcome, const char* why, Errc code = Errc::protocol) {
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().code, code);
    EXPECT_NE(outcome.error().what.find(why), std::string::npos) << outcome.error().what;
}

TEST(FrameGate, RefusesWhatIsOutOfTurn) {
    Gate gate;
    ASSERT_TRUE(gate.snapshot(5));
    expectRefused(gate.snapshot(5), "second Snapshot");
    expectRefused(gate.frame(7), "Frame 7 after frame 5");
    expectRefused(gate.gate.swap({.n = 6}), "Swap 6 after frame 5");
    expectRefused(Gate{}.gate.payload({.total = 10, .offset = 5, .tail = content(5, 1)}), "byte 0");
    Gate fit;
    ASSERT_TRUE(fit.snapshot(5));
    expectRefused(fit.gate.fit({.n = 6}), "Fit 6 after frame 5");
}

TEST(FrameGate, RefusesPartsOfDifferentPayloads) {
    Gate gate;
    const auto a = content(10, 1);
    const std::span<const std::byte> part{a};
    ASSERT_TRUE(gate.gate.payload({.hash = {1, 1}, .total = 20, .offset = 0, .tail = part}));
    expectRefused(gate.gate.payload({.hash = {2, 2}, .total = 20, .offset = 10, .tail = part}),
                  "found byte 10");
    expectRefused(gate.gate.payload({.hash = {1, 1}, .total = 20, .offset = 5, .tail = part}),
                  "found byte 5");
}

TEST(FrameGate, RefusesAPayloadThatIsNotWhatItsHashSays) {
    Gate gate;
    const auto bytes = content(10, 1);
    expectRefused(gate.gate.payload({.hash = {1, 2}, .total = 10, .offset = 0, .tail = bytes}),
                  "content hash");
}

TEST(FrameGate, KeepsNoMorePayloadsThanItsBudget) {
    Gate gate{100};
    ASSERT_TRUE(gate.upload(content(60, 1), 1));
    expectRefused(gate.upload(content(60, 2), 2), "the limit is 100", Errc::limit);
}

}  // namespace
}  // namespace gnomon::net
