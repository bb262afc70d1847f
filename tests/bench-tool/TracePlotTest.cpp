// A trace of frames: what gnomon run writes, gnomon plot reads and draws.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "FrameTrace.h"
#include "bench/TracePlot.h"

namespace gnomon::client {
namespace {

const std::string header = std::string{FrameTrace::header} + "\n";

TEST(Trace, ComesBackAsItWasWritten) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("gnomon-trace-" + std::to_string(::getpid()) + ".csv");
    const std::vector<net::ServerStatus> servers{{.state = net::ServerState::member},
                                                 {.state = net::ServerState::joining}};
    {
        FrameTrace trace{file, [](const std::string& why) { ADD_FAILURE() << why; }};
        const auto begun = FrameTrace::Clock::now();
        trace.add({.shown = 4}, servers, begun);
        trace.add({.shown = 5, .droppedNow = {"left", "a \"b\", c"}, .joinedNow = {"right"}},
                  servers, begun + std::chrono::milliseconds{250});
        trace.finish();
    }
    std::ifstream in{file};
    const auto rows = readTrace(in);
    std::filesystem::remove(file);
    ASSERT_TRUE(rows) << rows.error().what;
    ASSERT_EQ(rows->size(), 2U);
    EXPECT_EQ((*rows)[0].frame, 4U);
    EXPECT_EQ((*rows)[0].members, 1);
    EXPECT_EQ((*rows)[1].frame, 5U);
    EXPECT_DOUBLE_EQ((*rows)[1].ms, 250.0);
    EXPECT_DOUBLE_EQ((*rows)[1].s, 0.25);
    EXPECT_EQ((*rows)[1].dropped, "left a \"b\", c");
    EXPECT_EQ((*rows)[1].joined, "right");
}

TEST(Trace, WhatIsNoneIsRefusedByLine) {
    for (const auto& [text, line] :
         {std::pair{std::string{}, "1: "}, std::pair{std::string{"frame,ms\n"}, "1: "},
          std::pair{header + "1,0,0,4,,\n2,x,0,4,,\n", "3: "},
          std::pair{header + "1,0,0,4,\n", "2: "}, std::pair{header + "1,0,0,4,,,\n", "2: "}}) {
        std::istringstream in{text};
        const auto rows = readTrace(in);
        ASSERT_FALSE(rows) << text;
        EXPECT_EQ(rows.error().what.rfind(line, 0), 0U) << rows.error().what;
    }
}

/// A hundred frames a second for ten seconds; a gap of a second at five.
std::vector<TraceRow> gap() {
    std::vector<TraceRow> rows;
    for (int i = 0; i < 1000; ++i) {
        const bool late = i == 500;
        rows.push_back({.frame = static_cast<std::uint64_t>(i + 1),
                        .s = i * 0.01 + (i >= 500 ? 1.0 : 0.0),
                        .ms = late ? 1000.0 : 10.0,
                        .members = i >= 500 && i < 700 ? 3 : 4});
    }
    rows[500].dropped = "left";
    rows[700].joined = "left";
    return rows;
}

TEST(TracePlot, ShowsTheGapWhoWasDroppedAndWhoCameBack) {
    const auto rows = gap();
    const Plot plot = plotOf(rows, "a wall");
    const auto text = [&](const std::string& part) {
        return std::find_if(plot.texts.begin(), plot.texts.end(),
                            [&](const auto& each) { return each.text == part; });
    };
    const auto dropped = text("- left");
    const auto joined = text("+ left");
    ASSERT_NE(dropped, plot.texts.end());
    ASSERT_NE(joined, plot.texts.end());
    EXPECT_LT(dropped->x, joined->x);
    EXPECT_NE(text("a wall"), plot.texts.end());
    // The longest line of all is that of the longest frames, and peaks where it happened.
    const auto longest = std::max_element(
        plot.lines.begin(), plot.lines.end(),
        [](const auto& a, const auto& b) { return a.points.size() < b.points.size(); });
    const auto peak = std::min_element(longest->points.begin(), longest->points.end(),
                                       [](const auto& a, const auto& b) { return a[1] < b[1]; });
    EXPECT_NEAR((*peak)[0], dropped->x, 3.0);
    for (const auto& line : plot.lines)
        for (const auto& point : line.points) {
            EXPECT_GE(point[0], 0.0);
            EXPECT_LE(point[0], plot.width);
            EXPECT_GE(point[1], 0.0);
            EXPECT_LE(point[1], plot.height);
        }
    EXPECT_LT(plotSvg(plot).size(), 60'000U);
}

TEST(TracePlot, OfFewFramesIsStillOne) {
    for (const std::size_t count : {0, 1, 2}) {
        auto rows = gap();
        rows.resize(count);
        EXPECT_FALSE(plotSvg(plotOf(rows, "few")).empty());
    }
}

}  // namespace
}  // namespace gnomon::client
