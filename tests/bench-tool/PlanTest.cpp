// What is compared: techniques times map sizes times views ..., and the sweeps that are built in.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "bench/Plan.h"

namespace gnomon::client {
namespace {

const Registry registry{
    .fits = {"csm", "std", "trapez"}, .filters = {"hard", "pcf"}, .others = {"ray"}};

std::vector<std::string> labels(const Chapter& chapter) {
    std::vector<std::string> all;
    for (const Variant& v : chapter.variants)
        all.push_back(v.label + " " + std::to_string(v.mapSize()));
    return all;
}

std::vector<Chapter> chapters(const PlanOptions& options, const Registry& from = registry) {
    auto made = chaptersOf(options, from);
    EXPECT_TRUE(made) << made.error().what;
    return made ? *made : std::vector<Chapter>{};
}

const Chapter* find(const std::vector<Chapter>& all, const std::string& name) {
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    return at == all.end() ? nullptr : &*at;
}

TEST(Plan, IsTechniquesTimesMapSizesAndNoMapOnce) {
    const auto all = chapters({.techniques = {"none", "std", "ray"}, .mapSizes = {512, 1024}});
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(labels(all[0]),
              (std::vector<std::string>{"none 512", "std 512", "ray 512", "std 1024"}));
    EXPECT_EQ(all[0].motions, std::vector{Motion::still});
    EXPECT_EQ(all[0].flickerFrames, 0);
}

TEST(Plan, GatesAreEveryTechniqueThatIsBuiltInOverFourMapSizes) {
    const auto all = chapters({.sweep = "gates"});
    ASSERT_EQ(all.size(), 1U);
    const auto found = labels(all[0]);
    EXPECT_EQ(found.front(), "std 512") << "ratios are to the plain technique";
    for (const char* technique : {"csm", "std", "trapez", "std+pcf"})
        for (const char* size : {"512", "1024", "2048", "4096"})
            EXPECT_EQ(std::count(found.begin(), found.end(), std::string{technique} + " " + size),
                      1)
                << technique << size;
    EXPECT_EQ(found.size(), 4U * 4U + 2U) << "and none and ray once";
    EXPECT_GE(all[0].views.size(), 3U);
    EXPECT_EQ(all[0].motions.size(), 2U);
    EXPECT_GT(all[0].flickerFrames, 1);
}

TEST(Plan, TheThesisLeavesOutWhatIsNotBuiltIn) {
    const auto some = chapters({.sweep = "thesis"});
    for (const auto& chapter : some) {
        EXPECT_FALSE(chapter.variants.empty()) << chapter.name;
        EXPECT_FALSE(chapter.views.empty()) << chapter.name;
        for (const Variant& v : chapter.variants)
            EXPECT_TRUE(
                (std::set<std::string>{"csm", "std", "trapez", "pcf"}.count(v.shadow.technique)))
                << v.shadow.technique;
    }
    ASSERT_NE(find(some, "focus"), nullptr);
    std::set<double> ranges;
    for (const Variant& v : find(some, "focus")->variants) ranges.insert(v.shadow.range);
    EXPECT_GE(ranges.size(), 5U);
    EXPECT_EQ(labels(*find(some, "soft")).size(), 6U) << "std and pcf, three sizes";
    ASSERT_NE(find(some, "depth"), nullptr);
    EXPECT_EQ(find(some, "depth")->variants.size(), 3U) << "trapez: off, previous, exact";

    const auto hard = chapters({.sweep = "thesis"}, {.fits = {"std"}, .filters = {"hard"}});
    EXPECT_EQ(find(hard, "soft"), nullptr);
    EXPECT_EQ(find(hard, "focus"), nullptr);
    ASSERT_NE(find(hard, "resolutions"), nullptr);
    EXPECT_EQ(labels(*find(hard, "resolutions")).size(), 3U);
    // A filter that is registered some day takes part by itself.
    const auto later =
        chapters({.sweep = "thesis"}, {.fits = {"std"}, .filters = {"hard", "vsm", "ppcf"}});
    EXPECT_EQ(labels(*find(later, "soft")).size(), 9U);
}

TEST(Plan, WhatIsGivenTakesTheSweepsPlace) {
    const auto all = chapters({.sweep = "thesis",
                               .sizes = {{64, 48}, {32, 32}},
                               .motions = {Motion::moving},
                               .views = {{.name = "mine"}},
                               .flickerFrames = 3});
    for (const auto& chapter : all) {
        EXPECT_EQ(chapter.sizes, (std::vector<std::array<int, 2>>{{64, 48}, {32, 32}}));
        ASSERT_EQ(chapter.views.size(), 1U);
        EXPECT_EQ(chapter.views[0].name, "mine");
        EXPECT_EQ(chapter.motions, std::vector{Motion::moving});
        EXPECT_EQ(chapter.flickerFrames, 3);
    }
    const auto gates =
        chapters({.sweep = "gates", .techniques = {"std", "csm"}, .mapSizes = {256}});
    EXPECT_EQ(labels(gates[0]), (std::vector<std::string>{"std 256", "csm 256"}));
}

TEST(Plan, RefusesSweepsThatAreNotThere) {
    const auto none = chaptersOf({.sweep = "thseis"}, registry);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().what.find("gates or thesis"), std::string::npos);
    EXPECT_FALSE(chaptersOf({.sweep = "thesis", .techniques = {"std"}}, registry));
    EXPECT_FALSE(chaptersOf({.sweep = "thesis", .mapSizes = {512}}, registry));
}

TEST(Plan, ViewsMayBeForOneSceneAlone) {
    EXPECT_TRUE(BenchView{}.fits("a/plaza.glb"));
    EXPECT_TRUE((BenchView{.scene = "plaza"}.fits("a/plaza.glb")));
    EXPECT_TRUE((BenchView{.scene = "plaza.glb"}.fits("plaza.glb")));
    EXPECT_FALSE((BenchView{.scene = "grove"}.fits("a/plaza.glb")));
}

TEST(Plan, SunsAreWhereTheyAreSeen) {
    constexpr double pi = std::numbers::pi;
    // Looking along +x: behind is -x, to the right is +z.
    const Look look{.eye = {0, 2, 0}, .center = {5, 0, 0}};
    const auto is = [](const math::dvec3& a, const math::dvec3& b) {
        return glm::distance(a, b) < 1e-12;
    };
    EXPECT_TRUE(is(sunSeenFrom(look, {.azimuth = 0, .elevation = 0}).toward, {-1, 0, 0}));
    EXPECT_TRUE(is(sunSeenFrom(look, {.azimuth = pi / 2, .elevation = 0}).toward, {0, 0, 1}));
    EXPECT_TRUE(is(sunSeenFrom(look, {.azimuth = pi, .elevation = 0}).toward, {1, 0, 0}));
    EXPECT_TRUE(is(sunSeenFrom(look, {.azimuth = 1, .elevation = pi / 2}).toward, {0, 1, 0}));
    const Look down{.eye = {0, 5, 0}, .center = {0, 0, 0}, .up = {0, 0, -1}};
    EXPECT_NEAR(glm::length(sunSeenFrom(down, {.elevation = 0.5}).toward), 1.0, 1e-12);
}

}  // namespace
}  // namespace gnomon::client
