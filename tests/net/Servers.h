#pragma once

#include <gtest/gtest.h>

#include <deque>

#include "TestServer.h"

namespace gnomon::net::test {

/// So many servers, started but not connected.
class Servers {
public:
    explicit Servers(int count) {
        for (int i = 0; i < count; ++i) list_.emplace_back("server" + std::to_string(i));
    }
    TestServer& operator[](std::size_t i) { return list_[i]; }
    auto begin() { return list_.begin(); }
    auto end() { return list_.end(); }

private:
    std::deque<TestServer> list_;
};

/// All but one have applied frame @p n, and hold what the aspect does.
inline void expectTheSameEverywhere(Servers& servers, std::uint64_t n, field::Aspect& aspect,
                                    const TestServer* but = nullptr) {
    for (TestServer& server : servers) {
        if (&server == but) continue;
        ASSERT_TRUE(server.waitUntil([&](const Seen& s) { return s.digests.contains(n); }))
            << server.name();
        EXPECT_EQ(server.seen().digests.at(n), aspect.digest()) << server.name();
        EXPECT_EQ(server.seen().error, "");
    }
}

}  // namespace gnomon::net::test
