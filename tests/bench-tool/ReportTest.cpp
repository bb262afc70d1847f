// Tables of run time against error.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "Tables.h"
#include "bench/Report.h"

namespace gnomon::client {
namespace {

/// Commas outside quotation marks.
int commas(const std::string& line) {
    int count = 0;
    bool within = false;
    for (const char c : line) {
        if (c == '"') within = !within;
        if (c == ',' && !within) ++count;
    }
    return count;
}

TEST(Report, TheFrontHasWhatNothingBeats) {
    EXPECT_EQ(paretoFront(table().rows), (std::vector<bool>{true, true, true, false, true}));
    // Equals do not beat each other.
    EXPECT_EQ(paretoFront({row("a", 1, 5.0, 3), row("b", 1, 5.0, 3)}),
              (std::vector<bool>{true, true}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(Report, MediansHaveTheIntervalOfTheirRanks) {
    std::vector<double> values;
    for (int i = 99; i >= 0; --i) values.push_back(i);
    const Interval all = medianOf(values);
    EXPECT_EQ(all.median, 50.0);
    EXPECT_EQ(all.low, 40.0);  // 50 -+ 0.98 sqrt(100)
    EXPECT_EQ(all.high, 60.0);
    EXPECT_EQ(medianOf({7.0}).low, 7.0);
    EXPECT_EQ(medianOf({}).median, 0.0);
}

TEST(Report, CsvHasALineForEachRowOfEachTable) {
    auto flickering = table();
    flickering.dynamic = true;
    flickering.rows[0].cameraFlicker =
        FlickerError{.counted = 200, .flipped = 1, .meanChange = 0.5};
    flickering.rows[0].lightFlicker = FlickerError{.counted = 100, .flipped = 4};
    const std::string csv = benchCsv({table(), flickering});
    std::istringstream lines{csv};
    std::string head;
    std::getline(lines, head);
    int rows = 0;
    for (std::string line; std::getline(lines, line); ++rows)
        EXPECT_EQ(commas(line), commas(head)) << line;
    EXPECT_EQ(rows, 10);
    EXPECT_NE(csv.find(",64,48,static,lispsm,512,0,12.5000,"), std::string::npos);
    EXPECT_NE(csv.find(",0.50000,0.500000,4.00000,"), std::string::npos) << "flicker, percent";
    EXPECT_NE(csv.find(",\"side, \"\"low\"\"\","), std::string::npos);
}

TEST(Report, JsonSaysTheSame) {
    auto shown = table();
    shown.rows[1].bands = {0.125, 0.25, 0.5};
    shown.rows[1].peer = true;
    shown.rows[2].cameraFlicker = FlickerError{.counted = 200, .flipped = 1};
    const auto json = nlohmann::json::parse(benchJson({shown}));
    const auto& runs = json["tables"][0]["runs"];
    ASSERT_EQ(runs.size(), 5U);
    EXPECT_EQ(runs[1]["wrong_far"], 0.5);
    EXPECT_EQ(runs[1]["peer"], true);
    EXPECT_TRUE(runs[1]["flicker_camera"].is_null()) << "not measured is not nought";
    EXPECT_EQ(runs[2]["flicker_camera"]["share"], 0.005);
    EXPECT_EQ(json["tables"][0]["view"], "side, \"low\"");
}

TEST(Report, NamesCannotBreakThePageOrItsFiles) {
    const std::string html = benchHtml({table()});
    EXPECT_EQ(html.find("a<b>"), std::string::npos);
    EXPECT_NE(html.find("a&lt;b&gt;&amp;c.obj"), std::string::npos);
    const auto many = [&](const std::string& tag) {
        std::size_t count = 0;
        for (auto at = html.find(tag); at != html.npos; at = html.find(tag, at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(many("<tr"), 6U);
    EXPECT_EQ(many("<tr"), many("</tr>"));
    EXPECT_EQ(table().slug(), "a-b-c-obj-side-low-64-x-48-static");
    EXPECT_NE(html.find("plot-" + table().slug() + ".svg"), std::string::npos);
}

TEST(Report, TheTerminalGetsOneLineARow) {
    const std::string text = benchText(table());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);
    EXPECT_NE(text.find("* lispsm"), std::string::npos) << "the front";
    EXPECT_NE(text.find("  slow"), std::string::npos);
    EXPECT_EQ(text.find("flicker"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::client
