// Windows that swap together, where a driver says what this machine's does not.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "SwapGroup.h"

namespace gnomon::gl {
namespace {

struct Driver {
    unsigned mostGroups = 1;
    unsigned mostBarriers = 1;
    bool joins = true;
    bool binds = true;
    std::vector<unsigned> joined = {};
    std::vector<std::pair<unsigned, unsigned>> bound = {};

    SwapGroups groups() {
        return {.most =
                    [this](unsigned& groups, unsigned& barriers) {
                        groups = mostGroups;
                        barriers = mostBarriers;
                        return true;
                    },
                .join =
                    [this](unsigned group) {
                        joined.push_back(group);
                        return joins;
                    },
                .bind =
                    [this](unsigned group, unsigned barrier) {
                        bound.emplace_back(group, barrier);
                        return binds;
                    }};
    }
};

TEST(SwapGroup, JoinsAndBindsTheBarrier) {
    Driver driver;
    const auto outcome = joinSwapGroup(driver.groups());
    EXPECT_TRUE(outcome.joined);
    EXPECT_EQ(outcome.text, "swaps with all machines (swap group 1, barrier 1)");
    EXPECT_EQ(driver.joined, std::vector<unsigned>{1});
    EXPECT_EQ(driver.bound, (std::vector<std::pair<unsigned, unsigned>>{{1U, 1U}}));
}

TEST(SwapGroup, WithoutSyncHardwareItIsThatOfTheMachine) {
    Driver driver{.mostBarriers = 0};
    const auto outcome = joinSwapGroup(driver.groups());
    EXPECT_TRUE(outcome.joined);
    EXPECT_NE(outcome.text.find("no sync hardware"), std::string::npos);
    EXPECT_TRUE(driver.bound.empty());
}

TEST(SwapGroup, SaysWhyThereIsNone) {
    EXPECT_FALSE(joinSwapGroup({}).joined);
    EXPECT_NE(joinSwapGroup({}).text.find("GLX_NV_swap_group"), std::string::npos);
    Driver none{.mostGroups = 0};
    EXPECT_FALSE(joinSwapGroup(none.groups()).joined);
    EXPECT_TRUE(none.joined.empty());
    Driver shut{.joins = false};
    EXPECT_FALSE(joinSwapGroup(shut.groups()).joined);
    EXPECT_TRUE(shut.bound.empty());
    Driver unbound{.binds = false};
    EXPECT_TRUE(joinSwapGroup(unbound.groups()).joined);
    EXPECT_NE(joinSwapGroup(unbound.groups()).text.find("binds no barrier"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::gl
