// Plots: where marks are, and that both files of them are whole.
#include <gnomon/image/Png.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "Tables.h"
#include "bench/Plot.h"

namespace gnomon::client {
namespace {

/// Whether the tags of a text nest; what is wrong where not.
std::string brokenTag(const std::string& xml) {
    std::vector<std::string> open;
    for (auto at = xml.find('<'); at != xml.npos; at = xml.find('<', at + 1)) {
        const auto end = xml.find('>', at);
        if (end == xml.npos) return "a tag that does not end";
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (tag.empty() || tag.find('<') != tag.npos) return "a stray <";
        if (tag[0] == '?' || tag[0] == '!') continue;
        const std::string name =
            tag.substr(tag[0] == '/', tag.find_first_of(" \n/", 1) - (tag[0] == '/' ? 1U : 0U));
        if (tag[0] == '/') {
            if (open.empty() || open.back() != tag.substr(1)) return "</" + tag.substr(1);
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
    }
    return open.empty() ? "" : open.back() + " is not closed";
}

TEST(Plot, PutsFasterLeftAndWorseUp) {
    const Plot plot = plotOf(table());
    ASSERT_GE(plot.marks.size(), 5U);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(plot.marks[i].x, plot.marks[i - 1].x);
    EXPECT_LT(plot.marks[0].y, plot.marks[1].y);
    EXPECT_LT(plot.marks[1].y, plot.marks[2].y);
    EXPECT_LT(plot.marks[2].y, plot.marks[4].y) << "nothing wrong is at the bottom";
    for (const auto& mark : plot.marks) {
        EXPECT_GE(mark.x, 0.0);
        EXPECT_LE(mark.x, plot.width);
        EXPECT_GE(mark.y, 0.0);
        EXPECT_LE(mark.y, plot.height);
    }
}

TEST(Plot, FillsTheFrontAndDrawsPeersAsHollowDiamonds) {
    BenchTable with = table();
    with.rows.push_back(row("osg Fast", 512, 1.0, 1));
    with.rows.back().peer = true;
    const Plot plot = plotOf(with);
    using Shape = Plot::Mark::Shape;
    EXPECT_EQ(plot.marks[5].shape, Shape::diamond);
    EXPECT_FALSE(plot.marks[5].filled) << "though it is on the front";
    EXPECT_GT(plot.marks[5].radius, plot.marks[0].radius) << "which its size says";
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(plot.marks[i].shape, Shape::circle);
    EXPECT_TRUE(plot.marks[4].filled);
    EXPECT_FALSE(plot.marks[0].filled) << "the peer is faster and closer to the truth";
    // The legend names each technique once.
    int named = 0;
    for (const auto& text : plot.texts) named += text.text == "lispsm" ? 1 : 0;
    EXPECT_EQ(named, 1);
}

TEST(Plot, NamesMapSizesWhereThereAreMaps) {
    BenchTable kept{.rows = {row("none", 512, 1.0, 9), row("std", 512, 2.0, 5)}};
    kept.rows[1].mapBytes = 1 << 20;  // and no texel drawn in the last frame
    int sizes = 0;
    for (const auto& text : plotOf(kept).texts) sizes += text.text == "512" ? 1 : 0;
    EXPECT_EQ(sizes, 1);
}

TEST(Plot, TimesThatAreFarApartGoByTheirLogarithm) {
    BenchTable wide{.rows = {row("a", 1, 1.0, 1), row("b", 1, 10.0, 1), row("c", 1, 100.0, 1)}};
    const Plot plot = plotOf(wide);
    EXPECT_NEAR(plot.marks[1].x - plot.marks[0].x, plot.marks[2].x - plot.marks[1].x, 0.5);
}

TEST(Plot, IsWholeAsSvg) {
    for (const BenchTable& shown :
         {table(), BenchTable{}, BenchTable{.rows = {row("a", 1, 1.0, 0)}},
          BenchTable{.rows = {row("a", 1, 0.0, 0)}}, BenchTable{.rows = {row("a", 1, 1e-3, 1)}}}) {
        const Plot plot = plotOf(shown);
        for (const auto& mark : plot.marks) EXPECT_TRUE(std::isfinite(mark.x + mark.y));
        const std::string svg = plotSvg(plot);
        EXPECT_EQ(svg.find("<?xml"), 0U);
        EXPECT_NE(svg.find("</svg>"), std::string::npos);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(brokenTag(svg), "");
    }
    EXPECT_NE(brokenTag("<svg><g></svg>"), "") << "the check itself";
}

TEST(Plot, IsTheSameAsPng) {
    const Plot plot = plotOf(table());
    const auto file = std::filesystem::path{testing::TempDir()} / "gnomon-plot-test.png";
    writePlotPng(file, plot);
    const auto read = image::readPng(file);
    ASSERT_TRUE(read) << read.error().text();
    std::filesystem::remove(file);
    const double scale = read->width / plot.width;
    EXPECT_GE(scale, 1.0);
    EXPECT_EQ(read->height, static_cast<int>(plot.height * scale));
    const auto at = [&](double x, double y, int channel) {
        const auto pixel = static_cast<std::size_t>(static_cast<int>(y * scale) * read->width +
                                                    static_cast<int>(x * scale));
        return read->pixels[pixel * static_cast<std::size_t>(read->channels) +
                            static_cast<std::size_t>(channel)];
    };
    const auto& filled = plot.marks[4];
    const auto& hollow = plot.marks[3];
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(at(filled.x, filled.y, c), filled.color[static_cast<std::size_t>(c)] * 255.0,
                    2);
        EXPECT_NEAR(at(hollow.x, hollow.y + 1.0, c), 255, 2);
    }
    EXPECT_THROW(writePlotPng("/no/such/folder/plot.png", plot), Failure);
}

}  // namespace
}  // namespace gnomon::client
