#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "Table.h"

/// Run time against error as a drawing.
namespace gnomon::client {

/// Red, green, blue, 0 to 1, sRGB.
using PlotColor = std::array<double, 3>;

/// What is to be drawn, in pixels, y down; nothing of how. Lines lie below marks, texts on top.
struct Plot {
    struct Line {
        std::vector<std::array<double, 2>> points = {};
        PlotColor color = {};
        double width = 1.0;
        bool dashed = false;
    };
    struct Mark {
        enum class Shape { circle, diamond };
        Shape shape = Shape::circle;
        double x = 0.0, y = 0.0, radius = 4.0;
        bool filled = false;  ///< else white inside
        PlotColor color = {};
    };
    struct Text {
        enum class Align { left, centre, right };
        double x = 0.0, y = 0.0;  ///< of the baseline
        std::string text = {};
        Align align = Align::left;
        double size = 12.0;
        PlotColor color = {};
        bool upward = false;  ///< read from below
    };
    double width = 0.0, height = 0.0;
    std::vector<Line> lines = {};
    std::vector<Mark> marks = {};  ///< first those of the rows, in their order, then the legend's
    std::vector<Text> texts = {};
};

/// Run time to the right, as a multiple of the first row's, wrong pixels upward (logarithmic). A
/// technique's map sizes are joined; filled and larger is the Pareto front, joined by dashes;
/// hollow diamonds are peers.
Plot plotOf(const BenchTable& table);

/// The same drawing both ways. @throws Failure Errc::file
std::string plotSvg(const Plot& plot);
void writePlotPng(const std::filesystem::path& file, const Plot& plot);

}  // namespace gnomon::client
