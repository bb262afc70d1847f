// Two threads, an aspect each, exchanging change lists at a barrier. Run under the thread
// sanitizer.
#include <gnomon/field/Barrier.h>

#include <array>
#include <atomic>
#include <thread>

#include "Editor.h"

namespace gnomon::field::test {
namespace {

TEST(Threads, TwoAspectsExchangeChangeLists) {
    constexpr int rounds = 300;
    const TypeRegistry types = itemTypes();
    Barrier barrier;
    std::array<ChangeList, 2> exchanged;
    std::array<std::vector<std::uint64_t>, 2> digests;
    const auto work = [&](unsigned me) {
        Aspect aspect{types, static_cast<std::uint16_t>(me + 1)};
        Editor editor{aspect, me};
        for (int round = 0; round < rounds; ++round) {
            editor.steps(10);
            exchanged[me] = aspect.commit();
            barrier.enter(2);
            expectApplied(aspect.apply(exchanged[1 - me]));
            digests[me].push_back(aspect.digest());
            barrier.enter(2);  // nobody writes a list that is still read
        }
    };
    std::thread other{work, 1U};
    work(0);
    other.join();
    ASSERT_EQ(digests[0].size(), static_cast<std::size_t>(rounds));
    EXPECT_EQ(digests[0], digests[1]);
}

TEST(Threads, AListIsAppliedWhileItsSourceIsEditedOn) {
    const TypeRegistry types = itemTypes();
    Barrier barrier;
    Aspect source{types, 1};
    Editor editor{source, 4};
    ChangeList list;
    std::uint64_t expected = 0;
    std::thread reader{[&] {
        Aspect replica{types, 0};
        for (int round = 0; round < 200; ++round) {
            barrier.enter(2);
            const ChangeList mine = list;
            const auto digest = expected;
            barrier.enter(2);
            // From here on the source is edited, and bulk data is shared.
            expectApplied(replica.apply(mine));
            EXPECT_EQ(replica.digest(), digest) << round;
        }
    }};
    for (int round = 0; round < 200; ++round) {
        editor.steps(20);
        list = source.commit();
        expected = source.digest();
        barrier.enter(2);
        barrier.enter(2);
    }
    reader.join();
}

TEST(Barrier, LetsNobodyThroughBeforeAllAreIn) {
    constexpr std::size_t count = 4;
    Barrier barrier;
    std::atomic<int> entered{0};
    std::atomic<int> early{0};
    const auto work = [&] {
        for (int meeting = 1; meeting <= 200; ++meeting) {
            ++entered;
            barrier.enter(count);
            if (entered < meeting * static_cast<int>(count)) ++early;
            barrier.enter(count);
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back(work);
    work();
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(early, 0);
    barrier.enter(1);  // alone, one passes at once
}

}  // namespace
}  // namespace gnomon::field::test
