// What slow connections carry: chunks that were compressed, and what is made of those that are not
// what they say.
#include <gnomon/net/ClientMessages.h>
#include <gtest/gtest.h>
#include <lz4.h>

#include <cstring>

#include "Packer.h"

namespace gnomon::net {
namespace {

std::vector<std::byte> compressed(const std::vector<std::byte>& bytes) {
    std::vector<std::byte> packed(
        static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(bytes.size()))));
    const int count = LZ4_compress_default(
        reinterpret_cast<const char*>(bytes.data()), reinterpret_cast<char*>(packed.data()),
        static_cast<int>(bytes.size()), static_cast<int>(packed.size()));
    packed.resize(static_cast<std::size_t>(count));
    return packed;
}

std::vector<std::byte> message(const std::vector<std::byte>& tail, std::uint32_t size,
                               std::uint32_t inner = 16) {
    return body(wire::Packed{
        .inner = inner, .size = size, .head = {std::byte{1}, std::byte{2}}, .tail = tail});
}

TEST(Packer, PaysWhereTheConnectionIsSlower) {
    EXPECT_TRUE(packingPays(117e6, 400e6));   // 1 Gbit/s
    EXPECT_FALSE(packingPays(2.5e9, 400e6));  // this machine
    EXPECT_FALSE(packingPays(390e6, 400e6));  // nothing to be had
}

TEST(Unpacker, GivesBackTheMessage) {
    const std::vector<std::byte> tail(5000, std::byte{7});
    Unpacker unpacker;
    const auto made = unpacker.unpack(message(compressed(tail), 5000));
    ASSERT_TRUE(made.has_value());
    EXPECT_EQ(made->type, MessageType::payload);
    ASSERT_EQ(made->body.size(), 5002U);
    EXPECT_EQ(made->body[1], std::byte{2});
    EXPECT_EQ(std::memcmp(made->body.data() + 2, tail.data(), tail.size()), 0);
}

TEST(Unpacker, RefusesWhatIsNotWhatItSays) {
    const std::vector<std::byte> tail(5000, std::byte{7});
    const auto packed = compressed(tail);
    Unpacker unpacker;
    for (const std::uint32_t size : {1U, 4999U, 5001U, 500'000U}) {
        const auto made = unpacker.unpack(message(packed, size));
        ASSERT_FALSE(made.has_value()) << size;
        EXPECT_EQ(made.error().code, Errc::protocol);
        EXPECT_NE(made.error().what.find("compressed by LZ4"), std::string::npos);
    }
    for (std::size_t count = 0; count < packed.size(); ++count) {
        auto cut = packed;
        cut.resize(count);
        EXPECT_FALSE(unpacker.unpack(message(cut, 5000)).has_value()) << count;
    }
    EXPECT_FALSE(unpacker.unpack(message(packed, 0)).has_value());
    EXPECT_FALSE(unpacker.unpack(message(packed, std::uint32_t{1} << 31U)).has_value());
    for (const std::uint32_t inner : {0U, 2U, 18U, 80U})
        EXPECT_FALSE(unpacker.unpack(message(packed, 5000, inner)).has_value()) << inner;
}

}  // namespace
}  // namespace gnomon::net
