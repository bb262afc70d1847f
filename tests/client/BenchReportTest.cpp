// Tables and plots of run time against error.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "BenchReport.h"

namespace gnomon::client {
namespace {

BenchRow row(const std::string& technique, int mapSize, double ms, std::uint64_t wrong) {
    return {.technique = technique,
            .mapSize = mapSize,
            .frameMs = {.median = ms, .low = ms * 0.9, .high = ms * 1.1},
            .ratio = {.median = 1.0, .low = 0.9, .high = 1.1},
            .error = {.counted = 1000, .wrong = wrong}};
}

BenchTable table() {
    return {
        .scene = "a<b>&c.obj",
        .renderer = "a renderer",
        .width = 64,
        .height = 48,
        .frames = 50,
        .rows = {row("none", 512, 10.0, 50), row("std", 512, 12.0, 20), row("lispsm", 512, 12.5, 5),
                 row("slow", 512, 20.0, 5), row("lispsm", 1024, 14.0, 0)}};
}

TEST(BenchReport, TheFrontHasWhatNothingBeats) {
    EXPECT_EQ(paretoFront(table().rows), (std::vector<bool>{true, true, true, false, true}));
    // Equals do not beat each other.
    EXPECT_EQ(paretoFront({row("a", 1, 5.0, 3), row("b", 1, 5.0, 3)}),
              (std::vector<bool>{true, true}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(BenchReport, MediansHaveTheIntervalOfTheirRanks) {
    std::vector<double> values;
    for (int i = 99; i >= 0; --i) values.push_back(i);
    const Interval all = medianOf(values);
    EXPECT_EQ(all.median, 50.0);
    EXPECT_EQ(all.low, 40.0);  // 50 -+ 0.98 sqrt(100)
    EXPECT_EQ(all.high, 60.0);
    EXPECT_EQ(medianOf({7.0}).low, 7.0);
    EXPECT_EQ(medianOf({}).median, 0.0);
}

TEST(BenchReport, TheTableHasARowForEach) {
    std::istringstream lines{benchCsv(table())};
    std::string head;
    std::getline(lines, head);
    const auto columns = std::count(head.begin(), head.end(), ',');
    int rows = 0;
    for (std::string line; std::getline(lines, line); ++rows)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
    EXPECT_EQ(rows, 5);
    EXPECT_NE(benchCsv(table()).find("\nlispsm,512,12.5000,"), std::string::npos);
}

TEST(BenchReport, ThePlotPutsFasterLeftAndWorseUp) {
    const std::string svg = benchSvg(table());
    std::vector<std::pair<double, double>> dots;
    const std::regex circle{"<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\""};
    for (std::sregex_iterator at{svg.begin(), svg.end(), circle}, end; at != end; ++at)
        dots.emplace_back(std::stod((*at)[1]), std::stod((*at)[2]));
    ASSERT_EQ(dots.size(), 5U);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(dots[i].first, dots[i - 1].first);
    EXPECT_LT(dots[0].second, dots[1].second);
    EXPECT_LT(dots[1].second, dots[2].second);
    EXPECT_LT(dots[2].second, dots[4].second) << "nothing wrong is at the bottom";
    for (const auto& [x, y] : dots) {
        EXPECT_GE(x, 0.0);
        EXPECT_LE(x, 860.0);
        EXPECT_GE(y, 0.0);
        EXPECT_LE(y, 520.0);
    }
    // Without rows, and without any error.
    EXPECT_NE(benchSvg({}).find("</svg>"), std::string::npos);
    EXPECT_EQ(benchSvg({.rows = {row("a", 1, 1.0, 0)}}).find("nan"), std::string::npos);
}

TEST(BenchReport, NamesCannotBreakThePage) {
    const std::string html = benchHtml(table());
    EXPECT_EQ(html.find("a<b>"), std::string::npos);
    EXPECT_NE(html.find("a&lt;b&gt;&amp;c.obj"), std::string::npos);
    const auto many = [&](const std::string& tag) {
        std::size_t count = 0;
        for (auto at = html.find(tag); at != html.npos; at = html.find(tag, at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(many("<tr"), 6U);
    EXPECT_EQ(many("<tr"), many("</tr>"));
}

}  // namespace
}  // namespace gnomon::client
