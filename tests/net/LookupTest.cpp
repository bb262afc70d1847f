// What is said when a name is looked up, and who is believed; without sockets.
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/Lookup.h>
#include <gnomon/net/ServerMessages.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <utility>

#include "Allowance.h"
#include "Candidates.h"
#include "Datagrams.h"
#include "Responder.h"

namespace gnomon::net {
namespace {

using namespace std::chrono_literals;

std::vector<std::byte> question(const std::string& name = "left") {
    return datagram(wire::Lookup::padded(77, name));
}
std::vector<std::byte> announcement() {
    return datagram(wire::Announcement{.token = 77, .instance = 5, .port = 7430, .server = "left"});
}

/// A kind of datagram: its bytes, and what decoding and encoding again makes of others.
struct Kind {
    const char* name = "";
    std::vector<std::byte> bytes = {};
    std::function<Result<std::vector<std::byte>>(std::span<const std::byte>)> again = {};
};

template <class M>
Kind kind(const char* name, std::vector<std::byte> bytes, Route route) {
    return {name, std::move(bytes),
            [route](std::span<const std::byte> of) -> Result<std::vector<std::byte>> {
                auto message = decodeDatagram<M>(route, of);
                if (!message) return tl::unexpected{message.error()};
                return datagram(*message);
            }};
}

std::vector<Kind> kinds() {
    return {kind<wire::Lookup>("lookup", question(), Route::toServerLookup),
            kind<wire::Announcement>("announcement", announcement(), Route::toClientLookup)};
}

class EveryDatagram : public testing::TestWithParam<Kind> {};

TEST_P(EveryDatagram, ComesBackAsItWas) {
    const auto again = GetParam().again(GetParam().bytes);
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ(*again, GetParam().bytes);
}

TEST_P(EveryDatagram, CutShortIsRefused) {
    const std::span<const std::byte> whole{GetParam().bytes};
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto cut = GetParam().again(whole.first(size));
        ASSERT_FALSE(cut) << size;
        EXPECT_EQ(cut.error().code, Errc::protocol);
        // Also where its length says that this is all.
        auto patched = std::vector(whole.begin(), whole.begin() + static_cast<long>(size));
        if (size < 8) continue;
        patched[0] = static_cast<std::byte>(size - 8);
        EXPECT_FALSE(GetParam().again(patched)) << size;
    }
}

TEST_P(EveryDatagram, WithExtraBytesIsRefused) {
    for (const std::size_t more : {1U, 100U, 1000U}) {
        auto longer = GetParam().bytes;
        longer.resize(longer.size() + more);
        EXPECT_FALSE(GetParam().again(longer)) << more;
        const auto length = static_cast<std::uint32_t>(longer.size() - 8);
        std::memcpy(longer.data(), &length, 4);
        EXPECT_FALSE(GetParam().again(longer)) << more;
    }
}

TEST_P(EveryDatagram, OfAnotherProgramOrTypeIsRefused) {
    auto other = GetParam().bytes;
    other[8] = std::byte{0};
    const auto stranger = GetParam().again(other);
    ASSERT_FALSE(stranger);
    EXPECT_NE(stranger.error().what.find("not from a Gnomon program"), std::string::npos);
    other = GetParam().bytes;
    other[4] = std::byte{4};
    const auto swap = GetParam().again(other);
    ASSERT_FALSE(swap);
    EXPECT_NE(swap.error().what.find("message type 4, expected"), std::string::npos);
}

/// It is for who reads it to say what does not fit.
TEST_P(EveryDatagram, OfAnotherVersionHasTheSameForm) {
    auto other = GetParam().bytes;
    other[12] = std::byte{9};
    const auto again = GetParam().again(other);
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ(*again, other);
}

INSTANTIATE_TEST_SUITE_P(All, EveryDatagram, testing::ValuesIn(kinds()),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Datagram, ValuesThatMakeNoSenseAreRefused) {
    const auto refused = [](const wire::Announcement& message) {
        return !decodeDatagram<wire::Announcement>(Route::toClientLookup, datagram(message));
    };
    EXPECT_FALSE(refused({.port = 1, .server = "left"}));
    EXPECT_TRUE(refused({.port = 0, .server = "left"}));
    EXPECT_TRUE(refused({.port = 1}));
    EXPECT_TRUE(refused({.port = 1, .server = std::string(65, 'a')}));
    auto loaded = question();
    loaded.back() = std::byte{1};
    EXPECT_FALSE(decodeDatagram<wire::Lookup>(Route::toServerLookup, loaded));
}

const TimePoint start{1000s};

TEST(Responder, AnswersItsNameAndNoOther) {
    Responder responder{"left", 7430, 5};
    EXPECT_EQ(responder.answer(question(), start).value(), announcement());
    for (const char* other : {"right", "lef", "left2", "LEFT"})
        EXPECT_TRUE(responder.answer(question(other), start).value().empty()) << other;
    EXPECT_FALSE(responder.answer(announcement(), start));
    EXPECT_FALSE(responder.answer({}, start));
}

TEST(Responder, AnswersEveryVersionWithItsOwn) {
    Responder responder{"left", 7430, 5};
    auto other = question();
    other[12] = std::byte{9};
    EXPECT_EQ(responder.answer(other, start).value(), announcement());
}

TEST(Responder, IsNoAmplifier) {
    const std::string longest(maxLookupName, 'a');
    Responder responder{longest, 65535, ~std::uint64_t{0}};
    const auto asked = question(longest);
    EXPECT_EQ(asked.size(), maxDatagram);
    const auto answer = responder.answer(asked, start);
    ASSERT_TRUE(answer);
    EXPECT_FALSE(answer->empty());
    EXPECT_LE(answer->size(), asked.size());
}

TEST(Responder, AnswersSoManyASecond) {
    Responder responder{"left", 7430, 5};
    for (int second = 0; second < 3; ++second) {
        unsigned answered = 0;
        for (int i = 0; i < 999; ++i)
            if (!responder.answer(question(), start + second * 1s + i * 1ms)->empty()) ++answered;
        EXPECT_EQ(answered, Responder::mostPerSecond);
    }
    // Other names cost it nothing.
    for (int i = 0; i < 100; ++i) responder.answer(question("right"), start + 10s);
    EXPECT_FALSE(responder.answer(question(), start + 10s)->empty());
}

TEST(Allowance, IsFullAgainAfterASecond) {
    Allowance allowance{2};
    EXPECT_TRUE(allowance.take(start));
    EXPECT_TRUE(allowance.take(start + 900ms));
    EXPECT_FALSE(allowance.take(start + 999ms));
    EXPECT_EQ(allowance.next(), start + 1s);
    EXPECT_TRUE(allowance.take(start + 1s));
}

Place at(int number) { return {.host = "10.0.0." + std::to_string(number), .port = 7430}; }

TEST(Candidates, AreTriedOnceInTheirOrder) {
    Candidates candidates{1};
    EXPECT_FALSE(candidates.next());
    for (const int i : {3, 1, 2, 1}) candidates.add(at(i), static_cast<std::uint64_t>(i));
    for (const int i : {3, 1, 2}) EXPECT_EQ(candidates.next(), at(i));
    EXPECT_FALSE(candidates.next());
    // And in the next lookup those that answer again.
    candidates.begin();
    EXPECT_FALSE(candidates.next());
    candidates.add(at(1), 1);
    EXPECT_EQ(candidates.next(), at(1));
    EXPECT_FALSE(candidates.next());
}

TEST(Candidates, WhoFailedComesLastUntilItWorked) {
    Candidates candidates{1};
    const auto answer = [&] {
        candidates.begin();
        candidates.add(at(1), 1);
        candidates.add(at(2), 2);
    };
    answer();
    EXPECT_EQ(candidates.failuresOfNext(), 0U);
    EXPECT_EQ(candidates.next(), at(1));
    candidates.failed(at(1));
    answer();
    EXPECT_EQ(candidates.next(), at(2));
    EXPECT_EQ(candidates.failuresOfNext(), 1U);
    EXPECT_EQ(candidates.next(), at(1));
    candidates.worked(at(1));
    candidates.failed(at(2));
    answer();
    EXPECT_EQ(candidates.next(), at(1));
}

TEST(Candidates, SoManyAreTriedInOneLookup) {
    Candidates candidates{1};
    std::size_t tried = 0;
    const auto flood = [&] {
        for (int i = 0; i < 100; ++i) {
            candidates.add(at(i), static_cast<std::uint64_t>(i));
            tried += candidates.next() ? 1 : 0;
        }
    };
    flood();
    EXPECT_EQ(tried, Candidates::most);
    candidates.begin();
    flood();
    EXPECT_EQ(tried, 2 * Candidates::most);
}

TEST(Candidates, OneServerAtSeveralPlacesHasNoRival) {
    Candidates candidates{1};
    candidates.add(at(1), 7);
    candidates.add(at(2), 7);
    EXPECT_FALSE(candidates.rivals());
    EXPECT_EQ(candidates.all(), std::vector{at(1)});
    candidates.add(at(3), 8);
    EXPECT_EQ(candidates.rivals(), (std::pair{at(1), at(3)}));
    EXPECT_FALSE(candidates.rivals()) << "told already";
    EXPECT_EQ(candidates.all(), (std::vector{at(1), at(3)}));
    // One that was started again in the place of the old one is none.
    candidates.begin();
    candidates.add(at(1), 9);
    EXPECT_FALSE(candidates.rivals());
}

TEST(Candidates, HundredsOfLiarsKeepNobodyOutForEver) {
    Candidates candidates{1};
    const Place truth = at(200);
    bool tried = false;
    for (int lookup = 0; lookup < 50 && !tried; ++lookup) {
        candidates.begin();
        for (int i = 0; i < 150; ++i) candidates.add(at(i), static_cast<std::uint64_t>(i));
        candidates.add(truth, 200);
        for (int i = 150; i < 160; ++i) candidates.add(at(i), static_cast<std::uint64_t>(i));
        EXPECT_EQ(candidates.all().size(), Candidates::most);
        while (const auto next = candidates.next()) {
            tried = tried || *next == truth;
            candidates.failed(*next);
        }
    }
    EXPECT_TRUE(tried);
}

TEST(LookupGroup, IsAMulticastAddressWithAPort) {
    const auto group = parseLookupGroup(defaultLookupGroup);
    ASSERT_TRUE(group) << group.error().what;
    EXPECT_EQ(group->address, "239.255.74.30");
    EXPECT_EQ(group->port, 7430);
    for (const char* bad : {"", ":", "239.255.74.30", "239.255.74.30:", "239.255.74.30:0",
                            "239.255.74.30:65536", "239.255.74.30:7430 ", "10.0.0.1:7430",
                            "240.0.0.1:7430", "wall:7430", "[ff02::1]:7430", "239.255.74:7430"}) {
        const auto refused = parseLookupGroup(bad);
        ASSERT_FALSE(refused) << bad;
        EXPECT_NE(refused.error().what.find(std::string{"\""} + bad + "\""), std::string::npos);
    }
}

TEST(ServerAddress, IsNamedWithWhatIsKnown) {
    EXPECT_EQ(labelOf({.name = "left", .host = "pc1", .port = 7430}), "left (pc1:7430)");
    EXPECT_EQ(labelOf({.name = "left", .lookup = "239.255.74.30:7430"}), "left (looked up)");
}

}  // namespace
}  // namespace gnomon::net
