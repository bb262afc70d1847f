// What technique `auto` picks from what was measured.
#include <AutoTechnique.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::client {
namespace {

const std::vector<Measured> measured{
    {.technique = "std", .mapSize = 512, .ms = 10.0, .error = 3.0},
    {.technique = "std", .mapSize = 2048, .ms = 14.0, .error = 0.9},
    {.technique = "lispsm", .mapSize = 1024, .ms = 12.0, .error = 0.5},
    {.technique = "csm", .mapSize = 4096, .ms = 40.0, .error = 0.1},
    {.technique = "ray", .ms = 90.0, .error = 0.0},
};

std::string picked(const Budget& budget) {
    const Choice choice = choose(measured, budget);
    return choice.chosen.technique + " " + std::to_string(choice.chosen.mapSize);
}

TEST(AutoTechnique, LeastErrorWithinTheFrame) {
    EXPECT_EQ(picked({.frameMs = 11.0}), "std 512");
    EXPECT_EQ(picked({.frameMs = 13.0}), "lispsm 1024");
    EXPECT_EQ(picked({.frameMs = 50.0}), "csm 4096");
    EXPECT_EQ(picked({.frameMs = 1000.0}), "ray 0");
}

TEST(AutoTechnique, TheFastestWhereNothingIsWithinTheFrame) {
    EXPECT_EQ(picked({.frameMs = 5.0}), "std 512");
    EXPECT_NE(choose(measured, {.frameMs = 5.0}).why.find("nothing is within 5 ms"),
              std::string::npos);
}

TEST(AutoTechnique, TheFastestWithinTheError) {
    EXPECT_EQ(picked({.error = 1.0}), "lispsm 1024");
    EXPECT_EQ(picked({.error = 5.0}), "std 512");
    EXPECT_EQ(picked({.error = 0.2}), "csm 4096");
}

TEST(AutoTechnique, BothBudgets) {
    EXPECT_EQ(picked({.frameMs = 50.0, .error = 1.0}), "csm 4096");
    EXPECT_EQ(picked({.frameMs = 11.0, .error = 1.0}), "std 512") << "the frame comes first";
}

TEST(AutoTechnique, LeastErrorWhereNoneIsSmallEnough) {
    std::vector<Measured> coarse{measured[0], measured[1]};
    EXPECT_EQ(choose(coarse, {.error = 0.1}).chosen.mapSize, 2048);
}

TEST(AutoTechnique, WithoutABudgetThirtyFramesASecond) {
    EXPECT_NEAR(*budgetOf({}).frameMs, 33.3, 0.1);
    EXPECT_FALSE(budgetOf({.errorBudget = 0.5}).frameMs);
}

TEST(AutoTechnique, SoftLightsGetTheSoftFilter) {
    for (const Measured& candidate : candidates(true, false))
        EXPECT_TRUE(candidate.technique.find("+ppcf") != std::string::npos ||
                    candidate.technique == "ray");
    for (const Measured& candidate : candidates(false, false))
        EXPECT_EQ(candidate.technique.find('+'), std::string::npos);
}

TEST(AutoTechnique, MoreSamplesAreTriedForSoftLightsAlone) {
    const auto more = [](const std::vector<Measured>& all) {
        return std::count_if(all.begin(), all.end(), [](const Measured& m) { return m.quality; });
    };
    EXPECT_GT(more(candidates(true, false)), 0);
    EXPECT_EQ(more(candidates(false, false)), 0);
    EXPECT_EQ(more(candidates(true, true)), std::ssize(candidates(true, true)))
        << "whoever asks for it gets it";
}

}  // namespace
}  // namespace gnomon::client
